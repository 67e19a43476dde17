// SPDX-License-Identifier: Apache-2.0
#include "core/io/textfile.h"

#include "core/base/error.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace ps {
namespace {

/// Closes on the way out.
class Descriptor {
 public:
  explicit Descriptor(int fd) : m_fd(fd) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return m_fd; }
  bool close() {
    const int fd = m_fd;
    m_fd = -1;
    return fd < 0 || ::close(fd) == 0;
  }

 private:
  int m_fd;
};

/// A sentence for people: what happened and what to do.
std::string saveProblem(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      return "not saved: the disk is full; free some space or save elsewhere";
    case EACCES:
    case EPERM:
      return "not saved: no permission to write here; save elsewhere or change the permissions";
    case EROFS:
      return "not saved: the disk is read-only; save elsewhere";
    case ENOENT:
    case ENOTDIR:
      return "not saved: the folder does not exist; make it or save elsewhere";
    case EISDIR:
      return "not saved: this is a folder; choose a file name";
    case ENAMETOOLONG:
      return "not saved: the name is too long; choose a shorter one";
    default:
      return std::string("not saved: ") + std::strerror(code) + "; save elsewhere";
  }
}

[[noreturn]] void failSave(const std::string& path, int code, const std::string& leftover = {}) {
  if (!leftover.empty()) ::unlink(leftover.c_str());
  throw Error(path + ": " + saveProblem(code));
}

/// The file that a chain of symbolic links ends at, or the path itself.
std::string finalTarget(const std::string& path) {
  std::error_code problem;
  std::filesystem::path target(path);
  for (int hops = 0; hops < 16 && std::filesystem::is_symlink(target, problem); ++hops) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, problem);
    if (problem) break;
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return target.string();
}

int writeAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    if (count == 0) return ENOSPC;
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return 0;
}

/// Makes a rename last through a power failure; a file system that cannot do that is no reason to fail.
void syncFolder(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const Descriptor fd(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fd.get() >= 0) ::fsync(fd.get());
}

/// Takes bytes one after the other and keeps none: a pipe, a terminal, /dev/null.
bool isStream(mode_t mode) { return S_ISFIFO(mode) || S_ISCHR(mode); }

/// What stands at the path now (behind links), if anything. Throws Error where no bytes may go: a folder, a disk, a
/// socket, a file that is read-only.
std::optional<mode_t> writableModeAt(const std::string& path) {
  struct stat old {};
  if (::stat(path.c_str(), &old) != 0) return std::nullopt;
  if (S_ISDIR(old.st_mode)) failSave(path, EISDIR);
  if (!S_ISREG(old.st_mode) && !isStream(old.st_mode)) {
    throw Error(path + ": not saved: this is not a file; choose another name");
  }
  if (::access(path.c_str(), W_OK) != 0) failSave(path, errno);
  return old.st_mode;
}

/// A name that is free beside the target, and its open file.
int openTemporary(const std::string& path, std::string& temporary) {
  temporary += ".XXXXXX";
  const int fd = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (fd < 0) failSave(path, errno);
  return fd;
}

/// A pipe or device is no file to be replaced: a rename would put one in its place.
void writeStream(const std::string& path, std::string_view bytes) {
  Descriptor fd(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  if (fd.get() < 0) failSave(path, errno);
  if (const int code = writeAll(fd.get(), bytes); code != 0) failSave(path, code);
  if (!fd.close()) failSave(path, errno);
}

}  // namespace

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

void requireWritable(const std::string& path) {
  const std::optional<mode_t> old = writableModeAt(path);
  if (old && isStream(*old)) return;
  std::string temporary = finalTarget(path);
  const Descriptor fd(openTemporary(path, temporary));
  ::unlink(temporary.c_str());
}

void writeFileAtomically(const std::string& path, std::string_view bytes) {
  const std::optional<mode_t> old = writableModeAt(path);
  if (old && isStream(*old)) return writeStream(path, bytes);
  const std::string target = finalTarget(path);
  std::string temporary = target;
  Descriptor fd(openTemporary(path, temporary));
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const mode_t mode = old ? (*old & 07777) : (0666 & ~mask);
  if (::fchmod(fd.get(), mode) != 0) failSave(path, errno, temporary);
  if (const int code = writeAll(fd.get(), bytes); code != 0) failSave(path, code, temporary);
  if (::fsync(fd.get()) != 0 && errno != EINVAL) failSave(path, errno, temporary);
  if (!fd.close()) failSave(path, errno, temporary);
  if (::rename(temporary.c_str(), target.c_str()) != 0) failSave(path, errno, temporary);
  syncFolder(target);
}

}  // namespace ps
