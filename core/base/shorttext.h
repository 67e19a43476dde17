// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace ps {

/// A text that comes from outside, cut to `most` bytes at a character's end, with what is left out said: what a plugin
/// throws may be a megabyte long.
inline std::string shortText(std::string text, size_t most = 500) {
  if (text.size() <= most) return text;
  const size_t whole = text.size();
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80) --most;  // within a UTF-8 character
  text.resize(most);
  return text + "… (" + std::to_string(whole) + " bytes)";
}

}  // namespace ps
