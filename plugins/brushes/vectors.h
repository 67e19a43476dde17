// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include <cmath>

// What the brushes compute with the SDK's vectors.
namespace ps::brushes {

using api::Double3;

inline double dot(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Double3 cross(const Double3& a, const Double3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Double3 scaled(const Double3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Double3 sum(const Double3& a, const Double3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Double3 difference(const Double3& a, const Double3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline double norm(const Double3& a) { return std::sqrt(dot(a, a)); }
/// Zero stays zero.
inline Double3 unit(const Double3& a) {
  const double length = norm(a);
  return length > 0 ? scaled(a, 1 / length) : Double3{0, 0, 0};
}

}  // namespace ps::brushes
