// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace ps {

/// Bits of a number spread over all bits (Ellis, "lowbias32").
inline uint32_t scattered(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ x >> 16;
}

/// Points that fill a square and the half space over it evenly: an additive recurrence in four dimensions (Roberts
/// 2018, "The unreasonable effectiveness of quasirandom sequences"), shifted by a number of its own for each particle
/// (Cranley & Patterson 1976). In whole numbers, so that every machine finds the same ones.
class RaySamples {
 public:
  explicit RaySamples(uint32_t seed) {
    for (uint32_t q = 0; q < 4; ++q) m_shift[q] = scattered(seed * 4 + q + 1);
  }
  /// Coordinate q = 0 .. 3 of point `index`, in [0, 1).
  double at(uint32_t index, size_t q) const {
    // Powers of 1/g, g^5 = g + 1, in units of 2^-32.
    constexpr uint32_t kSteps[4] = {3679390609u, 3152041523u, 2700274806u, 2313257605u};
    return unit(m_shift[q] + index * kSteps[q]);
  }
  static double unit(uint32_t bits) { return bits * (1.0 / 4294967296.0); }

 private:
  uint32_t m_shift[4];
};

/// Unit vector about a normal by Lambert's cosine law; `across`: two unit vectors that make a right-handed frame with
/// it, u and v: numbers in [0, 1).
inline Vector3 diffuse(const Vector3& normal, const Vector3& one, const Vector3& other, double u, double v) {
  // Angles turned step by step: the C library's sine may differ in its last bit between machines.
  static const auto circle = [] {
    std::array<std::array<double, 2>, 1024> list{};
    double c = 1, s = 0;
    for (auto& point : list) {
      point = {c, s};
      constexpr double kCosine = 0.9999811752826011, kSine = 0.006135884649154475;  // of 2 pi / 1024
      const double turned = c * kCosine - s * kSine;
      s = s * kCosine + c * kSine;
      c = turned;
    }
    return list;
  }();
  const auto& at = circle[static_cast<size_t>(u * 1024)];
  const double r = std::sqrt(v);
  return std::sqrt(1 - v) * normal + r * at[0] * one + r * at[1] * other;
}

}  // namespace ps
