// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/log.h"

namespace ps::scripted {

Log::Log(const std::string& path) {
  if (!path.empty()) m_file.open(path, std::ios::app);
}

void Log::write(const nlohmann::json& line) {
  if (m_file.is_open()) m_file << line.dump() << std::endl;
}

}  // namespace ps::scripted
