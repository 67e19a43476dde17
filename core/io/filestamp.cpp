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

FileStamp stampOfBytes(const std::string& path) {
  FileStamp stamp = stampAt(path);
  try {
    if (stamp.known) stamp.hash = hashOf(readFile(path, kMaximumProjectBytes));
  } catch (const InputError&) {
    stamp.hash = 0;
  }
  return stamp;
}

uint64_t hashOf(std::string_view bytes) {
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

bool isUntouched(const FileStamp& a, const FileStamp& b) {
  return a.known && b.known && a.size == b.size && a.inode == b.inode && a.time == b.time;
}

bool holdsStamped(const std::string& path, const FileStamp& stamp) {
  const FileStamp now = stampAt(path);
  if (!now.known || !stamp.known || now.size != stamp.size) return false;
  if (isUntouched(now, stamp)) return true;
  try {
    return hashOf(readFile(path, kMaximumProjectBytes)) == stamp.hash;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace ps
