// SPDX-License-Identifier: Apache-2.0
#include "core/scene/coat.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace ps {

bool isColour(const std::string& coat) { return coat.starts_with(kNoColour); }

std::string colourCoat(const Vector3& rgb) {
  uint32_t number = 0xff;
  for (const double part : {rgb.x(), rgb.y(), rgb.z()}) {
    if (!(part >= 0)) return kNoColour;
    number = (number << 8) + static_cast<uint32_t>(std::lround(255 * std::min(part, 1.0)));
  }
  return coatOf(number);
}

uint32_t colourNumber(const std::string& coat) {
  constexpr size_t kDigits = 6;
  uint32_t number = 0;
  if (!isColour(coat) || coat.size() != kDigits + 1) return 0;
  const char *first = coat.data() + 1, *last = coat.data() + coat.size();
  if (const auto [end, error] = std::from_chars(first, last, number, 16); error != std::errc() || end != last) return 0;
  return 0xff000000 | number;
}

std::string coatOf(uint32_t colour) {
  if (colour == 0) return kNoColour;
  char text[8];
  std::snprintf(text, sizeof text, "#%06x", colour & 0xffffff);
  return text;
}

}  // namespace ps
