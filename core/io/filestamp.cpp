// SPDX-License-Identifier: Apache-2.0
#include "core/io/filestamp.h"

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/io/textfile.h"

#include <sys/stat.h>

namespace ps {

FileStamp stampOf(const struct stat& info) {
  if (!S_ISREG(info.st_mode)) return {};
  return {true, static_cast<uint64_t>(info.st_size), static_cast<uint64_t>(info.st_ino),
          int64_t{info.st_mtim.tv_sec} * 1'000'000'000 + info.st_mtim.tv_nsec, 0};
}

FileStamp stampAt(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 ? stampOf(info) : FileStamp{};
}

uint64_t hashOf(std::string_view bytes) {
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

bool holdsStamped(const std::string& path, const FileStamp& stamp) {
  const FileStamp now = stampAt(path);
  if (!now.known || !stamp.known || now.size != stamp.size) return false;
  if (now.inode == stamp.inode && now.time == stamp.time) return true;
  try {
    return hashOf(readFile(path, kMaximumProjectBytes)) == stamp.hash;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace ps
