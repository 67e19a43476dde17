// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ps {

/// The box by whose edges space repeats itself; an axis without period is open. Particles may lie in any image of it:
/// pairs are measured between their nearest images, so that nothing needs to be moved when it crosses a face.
class Period {
 public:
  Period() = default;
  /// Corners of the box in m, and the axes along which it repeats.
  Period(const api::Double3& minimum, const api::Double3& maximum, const std::array<bool, 3>& axes) {
    const double low[3] = {minimum.x, minimum.y, minimum.z}, high[3] = {maximum.x, maximum.y, maximum.z};
    for (size_t a = 0; a < 3; ++a) {
      m_low[a] = low[a];
      if (!axes[a]) continue;
      m_length[a] = static_cast<float>(high[a] - low[a]);
      m_inverse[a] = 1 / m_length[a];
      m_any = true;
    }
  }
  bool any() const { return m_any; }
  double low(size_t axis) const { return m_low[axis]; }         ///< m
  float length(size_t axis) const { return m_length[axis]; }    ///< m; 0 along an open axis
  float inverse(size_t axis) const { return m_inverse[axis]; }  ///< 1/m; 0 along an open axis
  bool operator==(const Period&) const = default;

  /// The shortest image of a difference of two coordinates. The images of d and -d are each other's negative to the
  /// last bit, so that a pair looks the same from both sides.
  float shortest(float d, size_t axis) const { return d - m_length[axis] * nearestInteger(d * m_inverse[axis]); }
  void shorten(float& x, float& y, float& z) const {
    if (!m_any) return;
    x = shortest(x, 0), y = shortest(y, 1), z = shortest(z, 2);
  }
  /// Periods by which a coordinate lies outside of the box.
  double imageOf(double coordinate, size_t axis) const {
    return std::floor((coordinate - m_low[axis]) * double{m_inverse[axis]});
  }
  /// The image of a coordinate within the box.
  double wrapped(double coordinate, size_t axis) const {
    return coordinate - double{m_length[axis]} * imageOf(coordinate, axis);
  }
  api::Double3 wrapped(const api::Double3& p) const {
    if (!m_any) return p;
    return {m_length[0] > 0 ? wrapped(p.x, 0) : p.x, m_length[1] > 0 ? wrapped(p.y, 1) : p.y,
            m_length[2] > 0 ? wrapped(p.z, 2) : p.z};
  }

 private:
  /// Halves go to the even one. Below 2^22, by the rounding of the addition alone: no call, on any instruction set.
  static float nearestInteger(float v) {
    constexpr float kShift = 12582912;  // 1.5 * 2^23
    return (v + kShift) - kShift;
  }
  std::array<double, 3> m_low{};
  std::array<float, 3> m_length{}, m_inverse{};
  bool m_any = false;
};

}  // namespace ps
