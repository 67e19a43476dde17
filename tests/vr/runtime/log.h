// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

namespace ps::scripted {

/// What happened, one JSON object a line. A line is on the disk when write() returns, so that a test may read along and
/// nothing is missing when the client crashes.
class Log {
 public:
  /// Appends to the file, since a client may make one instance after another; keeps nothing where `path` is empty.
  explicit Log(const std::string& path);
  void write(const nlohmann::json& line);

 private:
  std::ofstream m_file;
};

}  // namespace ps::scripted
