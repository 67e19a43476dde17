// SPDX-License-Identifier: Apache-2.0
#include "core/io/textfile.h"

#include "core/base/error.h"
#include "core/io/descriptor.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ps {

std::string readFile(const std::string& path, size_t limit) {
  const Descriptor fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (fd.get() < 0) {
    const int code = errno;
    if (code == ENOENT || code == ENOTDIR) throw InputError(path + ": no such file");
    if (code == EACCES) throw InputError(path + ": no permission to read it");
    throw InputError(path + ": cannot be opened: " + std::strerror(code));
  }
  struct stat info {};
  if (::fstat(fd.get(), &info) != 0) throw InputError(path + ": cannot be read: " + std::strerror(errno));
  if (S_ISDIR(info.st_mode)) throw InputError(path + ": is a folder, not a file");
  if (!S_ISREG(info.st_mode)) throw InputError(path + ": is not a regular file");
  const auto tooLarge = [&] {
    return InputError(path + ": is larger than " + std::to_string(limit >> 20) + " MiB, the largest that is read");
  };
  if (static_cast<size_t>(info.st_size) > limit) throw tooLarge();
  std::string bytes(static_cast<size_t>(info.st_size) + 1, '\0');
  size_t filled = 0;
  for (;;) {
    if (filled > limit) throw tooLarge();
    if (filled == bytes.size()) bytes.resize(bytes.size() * 2);
    const ssize_t count = ::read(fd.get(), bytes.data() + filled, bytes.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw InputError(path + ": cannot be read: " + std::strerror(errno));
    if (count == 0) break;
    filled += static_cast<size_t>(count);
  }
  bytes.resize(filled);
  return bytes;
}

}  // namespace ps
