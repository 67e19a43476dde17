// SPDX-License-Identifier: Apache-2.0
// Projects, states, tables, recordings, reports and notes are written through here: the bytes go to a new file beside
// the one they are for, and take its place when they are whole and on the disk. Whatever ends a program before leaves
// the old file as it was.
#include "core/io/outputfile.h"

#include "core/base/error.h"
#include "core/io/descriptor.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace ps {
namespace {

constexpr size_t kBuffer = size_t{1} << 16;
constexpr std::string_view kPart = ".part-";
constexpr size_t kLetters = 6;  // of mkostemp()

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

[[noreturn]] void failSave(const std::string& path, int code) { throw Error(path + ": " + saveProblem(code)); }

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

/// A new file beside the target, with the permissions that the target has or would get; `part` becomes its name. It is
/// locked while it is written: one that nobody locks was left by a program that is no more.
int openPart(const std::string& path, const std::optional<mode_t>& old, std::string& part) {
  part.append(kPart).append(kLetters, 'X');
  const int fd = ::mkostemp(part.data(), O_CLOEXEC);
  if (fd < 0) failSave(path, errno);
  ::flock(fd, LOCK_EX | LOCK_NB);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  if (::fchmod(fd, old ? (*old & 07777) : (0666 & ~mask)) == 0) return fd;
  const int code = errno;
  ::close(fd);
  ::unlink(part.c_str());
  failSave(path, code);
}

/// Whether a part is of no use to anybody. An empty one may be about to be locked.
bool isLeft(const std::string& part) {
  const Descriptor fd(::open(part.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  struct stat info {};
  return fd.get() >= 0 && ::fstat(fd.get(), &info) == 0 && S_ISREG(info.st_mode) &&
         ::flock(fd.get(), LOCK_SH | LOCK_NB) == 0 && (info.st_size > 0 || ::time(nullptr) - info.st_mtim.tv_sec > 2);
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : m_path(path) {
  const std::optional<mode_t> old = writableModeAt(path);
  if (old && isStream(*old)) {
    m_fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (m_fd < 0) failSave(path, errno);
  } else {
    m_target = m_part = finalTarget(path);
    m_fd = openPart(path, old, m_part);
  }
  m_buffer.reserve(kBuffer);
}

OutputFile::~OutputFile() {
  if (m_fd >= 0) ::close(m_fd);
  if (!m_part.empty()) ::unlink(m_part.c_str());
}

void OutputFile::write(std::string_view bytes) {
  if (m_buffer.size() + bytes.size() > kBuffer) flush();
  if (bytes.size() <= kBuffer) {
    m_buffer += bytes;
  } else if (const int code = writeAll(m_fd, bytes); code != 0) {
    failSave(m_path, code);
  }
}

void OutputFile::flush() {
  const int code = writeAll(m_fd, m_buffer);
  m_buffer.clear();
  if (code != 0) failSave(m_path, code);
}

FileStamp OutputFile::finish() {
  flush();
  if (!m_part.empty() && ::fsync(m_fd) != 0 && errno != EINVAL) failSave(m_path, errno);
  const Descriptor locked(m_part.empty() ? -1 : ::fcntl(m_fd, F_DUPFD_CLOEXEC, 0));  // until it has its name
  struct stat info {};
  ::fstat(m_fd, &info);
  if (::close(std::exchange(m_fd, -1)) != 0) failSave(m_path, errno);
  if (m_part.empty()) return {};
  if (::rename(m_part.c_str(), m_target.c_str()) != 0) failSave(m_path, errno);
  m_part.clear();
  syncFolder(m_target);
  return stampOf(info);
}

std::string OutputFile::keepPart() { return std::exchange(m_part, {}); }

FileStamp writeFileAtomically(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  FileStamp stamp = file.finish();
  if (stamp.known) stamp.hash = hashOf(bytes);
  return stamp;
}

void removeLeftParts(const std::string& folder, std::string_view name) {
  std::error_code problem;
  for (auto entry = std::filesystem::directory_iterator(folder, problem);
       !problem && entry != std::filesystem::directory_iterator(); entry.increment(problem)) {
    const std::string file = entry->path().filename().string();
    const size_t end = file.size() < kPart.size() + kLetters ? 0 : file.size() - kPart.size() - kLetters;
    if (end == 0 || file.compare(end, kPart.size(), kPart) != 0) continue;
    if (!name.empty() && file.compare(0, end, name) != 0) continue;
    if (isLeft(entry->path().string())) ::unlink(entry->path().c_str());
  }
}

void removeLeftParts(const std::string& path) {
  const std::filesystem::path target = std::filesystem::absolute(finalTarget(path));
  removeLeftParts(target.parent_path().string(), target.filename().string());
}

void requireWritable(const std::string& path) {
  const std::optional<mode_t> old = writableModeAt(path);
  if (old && isStream(*old)) return;  // a pipe is not to be opened twice
  const OutputFile trial(path);
}

void makeFolder(const std::string& path) {
  std::error_code problem;
  std::filesystem::create_directories(path, problem);
  if (!std::filesystem::is_directory(path, problem))
    throw Error(path + ": is not a folder and cannot be made; choose another");
}

std::string fileIdentity(const std::string& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0) {
    if (!S_ISREG(info.st_mode)) return {};
    return std::to_string(info.st_dev) + ':' + std::to_string(info.st_ino);
  }
  std::error_code problem;
  const std::filesystem::path whole =
      std::filesystem::weakly_canonical(std::filesystem::absolute(finalTarget(path)), problem);
  return problem ? path : whole.string();
}

}  // namespace ps
