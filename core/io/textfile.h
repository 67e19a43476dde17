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

}  // namespace ps
