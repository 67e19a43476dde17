// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/file.h"

#include "tests/fuzz/fuzz.h"

#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

namespace ps::fuzz {
namespace {

/// In memory where the system has a place for it.
std::filesystem::path folder() {
  const std::filesystem::path memory("/dev/shm");
  std::error_code none;
  return ::access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path(none);
}

}  // namespace

File::File(const char* name)
    : m_path((folder() / ("phasesketch-fuzz-" + std::to_string(::getpid()) + "-" + name)).string()),
      m_fd(::open(m_path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)) {
  require(m_fd >= 0, "a file can be made: " + m_path);
}

File::~File() {
  ::close(m_fd);
  ::unlink(m_path.c_str());
}

void File::write(std::string_view bytes) const {
  const bool whole =
      ::ftruncate(m_fd, 0) == 0 && ::pwrite(m_fd, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size());
  require(whole, "an input can be written: " + m_path);
}

}  // namespace ps::fuzz
