// SPDX-License-Identifier: Apache-2.0
#include "rotation.h"

#include <algorithm>

namespace ps::constraint {

Quaternion exponential(Vector v) {
  // Halved until the series of sine and cosine are exact to 1e-16, then squared as often.
  int halvings = 0;
  double scale = 0.5;
  for (double angle2 = 0.25 * dot(v, v); angle2 > 0.01 && halvings < 40; angle2 *= 0.25, scale *= 0.5) ++halvings;
  const double s = scale * scale * dot(v, v);
  const double sine = scale * (1 - s * (1.0 / 6) * (1 - s * (1.0 / 20) * (1 - s * (1.0 / 42) * (1 - s * (1.0 / 72)))));
  const double cosine = 1 - s * 0.5 * (1 - s * (1.0 / 12) * (1 - s * (1.0 / 30) * (1 - s * (1.0 / 56))));
  Quaternion q{sine * v.x, sine * v.y, sine * v.z, cosine};
  for (int k = 0; k < halvings; ++k) q = q * q;
  return normalised(q);
}

Vector logarithm(Quaternion q) {
  q = normalised(q);
  if (q.w < 0) q = {-q.x, -q.y, -q.z, -q.w};
  double scale = 2;
  // Square roots of the rotation until the series of the arc sine is exact to 1e-14.
  for (int k = 0; k < 8 && q.x * q.x + q.y * q.y + q.z * q.z > 1e-3; ++k, scale *= 2) {
    q = normalised({q.x, q.y, q.z, q.w + 1});
  }
  const double s = q.x * q.x + q.y * q.y + q.z * q.z;
  const double perSine = scale * (1 + s * (1.0 / 6 + s * (3.0 / 40 + s * (15.0 / 336 + s * (105.0 / 3456)))));
  return {perSine * q.x, perSine * q.y, perSine * q.z};
}

namespace {

struct Symmetric {
  double xx, yy, zz, xy, xz, yz;
  double trace() const { return xx + yy + zz; }
};

/// H^-1 g where H is safely positive definite: no eigenvalue far below the others.
bool solve(const Symmetric& h, Vector g, Vector& x) {
  constexpr double kSafe = 1e-4;
  const double a = h.yy * h.zz - h.yz * h.yz, b = h.xz * h.yz - h.xy * h.zz, c = h.xy * h.yz - h.xz * h.yy;
  const double minor = h.xx * h.yy - h.xy * h.xy, e = h.xy * h.xz - h.xx * h.yz;
  const double determinant = h.xx * a + h.xy * b + h.xz * c, sum = h.trace();
  if (!(sum > 0) || !(h.xx > 0) || !(minor > 0) || !(determinant > kSafe * sum * sum * sum)) return false;
  x = 1 / determinant *
      Vector{a * g.x + b * g.y + c * g.z, b * g.x + (h.xx * h.zz - h.xz * h.xz) * g.y + e * g.z,
             c * g.x + e * g.y + minor * g.z};
  return true;
}

/// The same with as much added to the diagonal as makes any H positive definite (Gershgorin): a step uphill.
bool solveDamped(Symmetric h, Vector g, Vector& x) {
  constexpr double kFloor = 0.02;  // of the diagonal
  const double lowest = std::min({h.xx - std::abs(h.xy) - std::abs(h.xz), h.yy - std::abs(h.xy) - std::abs(h.yz),
                                  h.zz - std::abs(h.xz) - std::abs(h.yz)});
  const double more =
      std::max(0.0, -lowest) + kFloor * (std::abs(h.xx) + std::abs(h.yy) + std::abs(h.zz) + std::abs(lowest));
  h.xx += more, h.yy += more, h.zz += more;
  return solve(h, g, x);
}

}  // namespace

Quaternion rotationOf(const Matrix& a, Quaternion q, double exact) {
  constexpr int kMost = 60;
  for (int k = 0; k < kMost; ++k) {
    // M = A R^T: its axial vector is the slope of the trace against a turn, tr(M) - M its curvature.
    const Matrix r = matrixOf(q);
    Matrix m;
    for (size_t i = 0; i < 3; ++i) m.row[i] = r * a.row[i];
    const double trace = m.row[0].x + m.row[1].y + m.row[2].z;
    const Vector slope{m.row[2].y - m.row[1].z, m.row[0].z - m.row[2].x, m.row[1].x - m.row[0].y};
    const Symmetric curvature{trace - m.row[0].x,
                              trace - m.row[1].y,
                              trace - m.row[2].z,
                              -0.5 * (m.row[0].y + m.row[1].x),
                              -0.5 * (m.row[0].z + m.row[2].x),
                              -0.5 * (m.row[1].z + m.row[2].y)};
    Vector turn;
    const bool whole = solve(curvature, slope, turn);
    if (!whole && !solveDamped(curvature, slope, turn)) break;
    const double angle2 = dot(turn, turn);
    if (!(angle2 > exact * exact) || !std::isfinite(angle2)) break;
    if (angle2 > 1) turn = 1 / std::sqrt(angle2) * turn;
    q = normalised(exponential(turn) * q);
    if (whole && angle2 < kLastTurn * exact) break;
  }
  return q;
}

Matrix pseudoInverse(const Matrix& m, double least) {
  double a[3][3] = {
      {m.row[0].x, m.row[0].y, m.row[0].z}, {m.row[1].x, m.row[1].y, m.row[1].z}, {m.row[2].x, m.row[2].y, m.row[2].z}};
  double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // columns
  for (int sweep = 0; sweep < 12; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        if (a[p][q] == 0) continue;
        const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 3; ++k) {
          const double akp = a[k][p], akq = a[k][q];
          a[k][p] = c * akp - s * akq, a[k][q] = s * akp + c * akq;
        }
        for (int k = 0; k < 3; ++k) {
          const double apk = a[p][k], aqk = a[q][k];
          a[p][k] = c * apk - s * aqk, a[q][k] = s * apk + c * aqk;
        }
        for (auto& axis : axes) {
          const double xp = axis[p], xq = axis[q];
          axis[p] = c * xp - s * xq, axis[q] = s * xp + c * xq;
        }
      }
    }
  }
  least = std::max(least, 1e-6 * std::max({a[0][0], a[1][1], a[2][2]}));
  Matrix inverse;
  for (size_t k = 0; k < 3; ++k) {
    if (!(a[k][k] > least)) continue;
    const Vector axis{axes[0][k], axes[1][k], axes[2][k]};
    addOuter(inverse, 1 / a[k][k], axis, axis);
  }
  return inverse;
}

Matrix symmetricInverse(const Matrix& m) {
  const Vector x = cross(m.row[1], m.row[2]), y = cross(m.row[2], m.row[0]), z = cross(m.row[0], m.row[1]);
  const double determinant = dot(m.row[0], x), size = m.row[0].x + m.row[1].y + m.row[2].z;
  if (!(determinant > 1e-4 * size * size * size)) return pseudoInverse(m);
  const double s = 1 / determinant;
  return {{s * x, s * y, s * z}};
}

double cubeRoot(double s) {
  double y = 1 + (s - 1) / 3;
  for (int k = 0; k < 4; ++k) {
    const double y3 = y * y * y;
    y *= (y3 + 2 * s) / (2 * y3 + s);
  }
  return y;
}

}  // namespace ps::constraint
