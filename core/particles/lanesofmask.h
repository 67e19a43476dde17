// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>

namespace ps {

/// The lane that comes `place`-th when those under a mask come first, in their order, and then the others.
constexpr uint32_t laneAt(uint32_t place, uint32_t bits, uint32_t lanes) {
  for (const uint32_t wanted : {1u, 0u}) {
    for (uint32_t lane = 0; lane < lanes; ++lane) {
      if ((bits >> lane & 1) == wanted && place-- == 0) return lane;
    }
  }
  return 0;
}

/// By the bits of a mask of eight lanes: laneAt() in four bits each, the first one lowest.
inline constexpr std::array<uint32_t, 256> kLanesOfEight = [] {
  std::array<uint32_t, 256> table{};
  for (uint32_t bits = 0; bits < table.size(); ++bits) {
    for (uint32_t place = 0; place < 8; ++place) table[bits] |= laneAt(place, bits, 8) << (4 * place);
  }
  return table;
}();

/// By the bits of a mask of four lanes: the bytes of laneAt(), 16 for each mask.
alignas(16) inline constexpr std::array<uint8_t, 256> kBytesOfFour = [] {
  std::array<uint8_t, 256> table{};
  for (uint32_t k = 0; k < table.size(); ++k) table[k] = static_cast<uint8_t>(4 * laneAt(k / 4 % 4, k / 16, 4) + k % 4);
  return table;
}();

}  // namespace ps
