// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/utf8.h"

#include <cstdio>
#include <string>

namespace ps {

/// A text that comes from outside, cut to `most` bytes at a character's end, with what is left out said: what a plugin
/// throws may be a megabyte long.
inline std::string shortText(std::string text, size_t most = 500) {
  if (text.size() <= most) return text;
  return cutText(text, most) + " (" + std::to_string(text.size()) + " bytes)";
}

/// "0.123457": six digits of a number, for people.
inline std::string sixDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace ps
