// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

struct stat;

namespace ps {

/// What a file was when it was read or written, so that a change by somebody else is noticed before it is replaced.
struct FileStamp {
  bool known = false;  ///< the rest says something
  uint64_t size = 0;   ///< bytes
  uint64_t inode = 0;
  int64_t time = 0;   ///< of the last change, ns since 1970
  uint64_t hash = 0;  ///< of the bytes
};

/// Without its hash.
FileStamp stampOf(const struct stat& info);
/// Without its hash; not known where there is no regular file.
FileStamp stampAt(const std::string& path);
/// With its hash, which is 0 of what cannot be read. Not for the user interface's thread.
FileStamp stampOfBytes(const std::string& path);
uint64_t hashOf(std::string_view bytes);
/// Whether size, place and time are the same. False where one of them is not known.
bool isUntouched(const FileStamp& a, const FileStamp& b);
/// Whether the file holds the bytes that were stamped. They are read where size, time and place do not settle it: not
/// for the user interface's thread. False where there is no file, or where it cannot be read.
bool holdsStamped(const std::string& path, const FileStamp& stamp);

}  // namespace ps
