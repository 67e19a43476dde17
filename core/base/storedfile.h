// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace ps {

/// A file that stays open, so that pieces of it can be read again, whatever becomes of its name. For any thread, and
/// for several at a time.
class StoredFile {
 public:
  /// To be read. Throws InputError "path: cannot be read: why".
  explicit StoredFile(const std::string& path);
  /// One without a name in a folder, which is made where there is none: the system takes it away when it is closed,
  /// however its program ends. Throws Error.
  static std::shared_ptr<StoredFile> nameless(const std::string& folder);
  ~StoredFile();
  StoredFile(const StoredFile&) = delete;
  StoredFile& operator=(const StoredFile&) = delete;

  uint64_t size() const { return m_size; }
  /// Throws InputError where there are fewer.
  std::string read(uint64_t at, size_t count) const;
  /// Writes at the end, of a nameless file, and returns where. Throws Error where the disk is full.
  uint64_t append(std::string_view bytes);
  /// Gives what was appended there back to the disk.
  void release(uint64_t at, size_t count);
  /// Disk space that so many appended bytes take.
  static size_t room(size_t count) { return (count + kPage - 1) / kPage * kPage; }

 private:
  static constexpr size_t kPage = 4096;  ///< what the disk takes back are whole pages
  StoredFile(int fd, std::string path) : m_path(std::move(path)), m_fd(fd) {}
  std::string m_path;
  int m_fd = -1;
  std::atomic<uint64_t> m_size{0};
};

}  // namespace ps
