// SPDX-License-Identifier: Apache-2.0
#include "core/base/storedfile.h"

#include "core/base/error.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>
#include <utility>

namespace ps {

StoredFile::StoredFile(const std::string& path)
    : m_path(path), m_fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  struct stat info {};
  if (m_fd < 0 || ::fstat(m_fd, &info) != 0) throw InputError(path + ": cannot be read: " + std::strerror(errno));
  if (!S_ISREG(info.st_mode)) {
    ::close(m_fd);
    throw InputError(path + ": cannot be read: it is not a file");
  }
  m_size = static_cast<uint64_t>(info.st_size);
}

std::shared_ptr<StoredFile> StoredFile::nameless(const std::string& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  std::string name = folder + "/recording-XXXXXX";
  const int fd = ::mkostemp(name.data(), O_CLOEXEC);
  if (fd < 0) throw Error(folder + ": no file can be made here: " + std::strerror(errno));
  ::unlink(name.c_str());
  return std::shared_ptr<StoredFile>(new StoredFile(fd, folder));
}

StoredFile::~StoredFile() { ::close(m_fd); }

std::string StoredFile::read(uint64_t at, size_t count) const {
  const uint64_t size = m_size;
  if (at > size || count > size - at) throw InputError(m_path + ": is cut off");
  std::string bytes(count, '\0');
  for (size_t done = 0; done < count;) {
    const ssize_t got = ::pread(m_fd, bytes.data() + done, count - done, static_cast<off_t>(at + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError(m_path + ": cannot be read: " + std::strerror(errno));
    if (got == 0) throw InputError(m_path + ": is cut off");
    done += static_cast<size_t>(got);
  }
  return bytes;
}

uint64_t StoredFile::append(std::string_view bytes) {
  const uint64_t at = m_size.fetch_add(room(bytes.size()));
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t put = ::pwrite(m_fd, bytes.data() + done, bytes.size() - done, static_cast<off_t>(at + done));
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) {
      const int code = put < 0 ? errno : ENOSPC;
      release(at, bytes.size());
      throw Error(m_path + ": " + std::strerror(code));
    }
    done += static_cast<size_t>(put);
  }
  return at;
}

/// A disk that cannot do that has the room back when the file is closed.
void StoredFile::release(uint64_t at, size_t count) {
  ::fallocate(m_fd, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, static_cast<off_t>(at),
              static_cast<off_t>(room(count)));
}

}  // namespace ps
