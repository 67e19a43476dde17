// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include <array>
#include <cmath>

// Rotations in double precision from additions, products and square roots alone: the same bits on every machine, which
// the sines of a standard library do not promise.
namespace ps::constraint {

struct Vector {
  double x = 0, y = 0, z = 0;
};
inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vector& operator+=(Vector& a, Vector b) { return a = a + b; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Vector vectorOf(const api::Float4& v) { return {v.x, v.y, v.z}; }
inline void setVector(api::Float4& to, Vector from) {
  to.x = static_cast<float>(from.x), to.y = static_cast<float>(from.y), to.z = static_cast<float>(from.z);
}

/// Three rows.
struct Matrix {
  std::array<Vector, 3> row{};
  Vector column(size_t k) const {
    const auto at = [&](const Vector& v) { return k == 0 ? v.x : k == 1 ? v.y : v.z; };
    return {at(row[0]), at(row[1]), at(row[2])};
  }
};
inline Matrix& operator+=(Matrix& a, const Matrix& b) {
  for (size_t row = 0; row < 3; ++row) a.row[row] += b.row[row];
  return a;
}
inline Vector operator*(const Matrix& m, Vector v) { return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)}; }
inline Vector transposedTimes(const Matrix& m, Vector v) { return v.x * m.row[0] + v.y * m.row[1] + v.z * m.row[2]; }
/// m += s a b^T
inline void addOuter(Matrix& m, double s, Vector a, Vector b) {
  m.row[0] += s * a.x * b;
  m.row[1] += s * a.y * b;
  m.row[2] += s * a.z * b;
}

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};
inline Quaternion operator*(Quaternion a, Quaternion b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
inline Quaternion conjugate(Quaternion q) { return {-q.x, -q.y, -q.z, q.w}; }
/// Of unit length; no rotation for what has no length or is no number.
inline Quaternion normalised(Quaternion q) {
  const double length2 = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(length2 > 1e-30) || !std::isfinite(length2)) return {};
  const double s = 1 / std::sqrt(length2);
  return {s * q.x, s * q.y, s * q.z, s * q.w};
}
inline Matrix matrixOf(Quaternion q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z,
               wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{Vector{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
           Vector{2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
           Vector{2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}}};
}
/// Rotation by the angle |v| in rad about v.
Quaternion exponential(Vector v);
/// Its inverse: the shorter of the two ways, at most pi rad.
Vector logarithm(Quaternion q);

/// Rotation R that maximises the trace of R^T A: the rotational part of A, by Newton's method on the rotations,
/// started from `q`, until a step turns by less than `exact` rad. Where the trace is not curved downwards in every
/// direction (a line, a point, far from the solution) the curvature is shifted until it is, so that each step goes up
/// (Levenberg's method). What A leaves open stays as in `q`.
Quaternion rotationOf(const Matrix& a, Quaternion q, double exact = 1e-13);

/// Inverse of a symmetric, positive semidefinite matrix, zero along axes whose eigenvalue is below 1e-6 of the largest
/// (a row of particles has no inertia about itself), or `least` at most: where all of them are rounding. Jacobi's
/// eigenvalue method.
Matrix pseudoInverse(const Matrix& m, double least = 0);

/// The same by cofactors where no axis is near that bound: several times as fast.
Matrix symmetricInverse(const Matrix& m);

/// Newton's method squares what is left at each step, where nothing is shifted: after a turn by an angle whose square
/// is this share of what rotationOf() is to leave, no other one is needed.
inline constexpr double kLastTurn = 0.01;

/// For ratios near 1, by Halley's method: exact to 1e-12 from 0.5 to 2.
double cubeRoot(double s);

}  // namespace ps::constraint
