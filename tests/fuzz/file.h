// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace ps::fuzz {

/// A file in memory, for what reads by name; of this process, and gone with it.
class File {
 public:
  explicit File(const char* name);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  const std::string& path() const { return m_path; }
  void write(std::string_view bytes) const;

 private:
  std::string m_path;
  int m_fd = -1;
};

}  // namespace ps::fuzz
