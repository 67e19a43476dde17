// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/utf8.h"

#include <string>

namespace ps {

/// A text that comes from outside, cut to `most` bytes at a character's end, with what is left out said: what a plugin
/// throws may be a megabyte long.
inline std::string shortText(std::string text, size_t most = 500) {
  if (text.size() <= most) return text;
  return cutText(text, most) + " (" + std::to_string(text.size()) + " bytes)";
}

}  // namespace ps
