// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace ps {

/// Largest project that is read; a sketched scene of a million runs stays under a twentieth of it, the rest is for the
/// state of a million particles.
inline constexpr size_t kMaximumProjectBytes = size_t{512} << 20;

/// The bytes of a regular file. Throws InputError "path: what is wrong": missing, a folder, not a regular file, not
/// readable, larger than `limit` bytes.
std::string readFile(const std::string& path, size_t limit);

/// Replaces a file as a whole: the bytes go to a new file beside it, are flushed to the disk, and take its name. The
/// old file stays until then, and its permissions are kept; through a symbolic link the file behind it is replaced.
/// Into a pipe or a character device (/dev/stdout) the bytes are written as they are. Throws Error "path: what
/// happened; what to do" (full disk, read-only, missing folder).
void writeFileAtomically(const std::string& path, std::string_view bytes);

/// Throws what writeFileAtomically() would throw for this path as things stand; leaves no trace. For results that come
/// after long work.
void requireWritable(const std::string& path);

}  // namespace ps
