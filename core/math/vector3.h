// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include <array>

namespace ps {

/// Three numbers in double precision, for what few bodies need; hot loops over particles are vectorised elsewhere.
struct Vector3 {
  double x = 0, y = 0, z = 0;
};
inline Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector3 operator*(double s, Vector3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector3 cross(Vector3 a, Vector3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// A matrix of three rows, times v.
inline Vector3 times(const std::array<Vector3, 3>& rows, Vector3 v) {
  return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}
inline Vector3 vectorOf(const api::Float4& v) { return {v.x, v.y, v.z}; }

}  // namespace ps
