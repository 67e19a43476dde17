// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ps {

/// Bytes as text (RFC 4648), padded and without line ends.
std::string toBase64(std::span<const std::byte> bytes);
/// The bytes again; nothing for text that toBase64() does not write.
std::optional<std::vector<std::byte>> fromBase64(std::string_view text);

}  // namespace ps
