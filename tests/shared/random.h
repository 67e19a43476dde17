// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace ps::testing {

/// SplitMix64 (Steele et al. 2014) in [0, 1): the same numbers on every machine.
class Random {
 public:
  explicit Random(uint64_t seed) : m_state(seed) {}
  double next() {
    uint64_t z = (m_state += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
  }
  /// In [low, low + size).
  double next(double low, double size) { return low + size * next(); }

 private:
  uint64_t m_state;
};

}  // namespace ps::testing
