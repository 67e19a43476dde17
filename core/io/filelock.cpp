// SPDX-License-Identifier: Apache-2.0
// flock() rather than a file's mere existence, or a number of a process in it: both outlive a crash, and a number means
// nothing on another machine. The file goes with the lock, hence the look whether the one that was locked is still the
// one of that name.
#include "core/io/filelock.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace ps {
namespace {

bool isAt(int fd, const std::string& path) {
  struct stat open {
  }, named{};
  return ::fstat(fd, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

std::string lineOf(int fd) {
  char text[256];
  const ssize_t count = ::pread(fd, text, sizeof text, 0);
  const std::string all(text, count > 0 ? static_cast<size_t>(count) : 0);
  return all.substr(0, all.find('\n'));
}

}  // namespace

FileLock::FileLock(std::string path, const std::string& note) : m_path(std::move(path)), m_note(note + '\n') { lock(); }

FileLock::~FileLock() {
  if (held()) ::unlink(m_path.c_str());
  if (m_fd >= 0) ::close(m_fd);
}

void FileLock::lock() {
  m_busy = false;
  for (int attempt = 0; attempt < 20; ++attempt) {
    constexpr int kFlags = O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW;
    int fd = ::open(m_path.c_str(), O_RDWR | O_CREAT | kFlags, 0666);
    if (fd < 0) fd = ::open(m_path.c_str(), O_RDONLY | kFlags);  // somebody else's file can be locked all the same
    if (fd < 0) return;
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
      m_busy = errno == EWOULDBLOCK;
      m_holder = lineOf(fd);
      ::close(fd);
      return;
    }
    if (isAt(fd, m_path)) {
      m_fd = fd;
      // For people: the lock holds without it.
      if (::ftruncate(fd, 0) == 0 && ::pwrite(fd, m_note.data(), m_note.size(), 0) < 0) return;
      return;
    }
    ::close(fd);  // its holder has just let it go, and the file with it
  }
}

bool FileLock::held() const { return m_fd >= 0 && isAt(m_fd, m_path); }

void FileLock::takeOver() {
  if (held()) return;
  if (m_fd >= 0) ::close(std::exchange(m_fd, -1));
  ::unlink(m_path.c_str());
  lock();
}

bool FileLock::isHeld(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0) return false;
  const bool held = ::flock(fd, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;  // shared: two who ask do not meet
  ::close(fd);
  return held;
}

}  // namespace ps
