// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/inertia.h"

#include "core/particles/particlestore.h"
#include "core/solver/contact/membersums.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace ps {
namespace {

/// Places are in single precision: below 1e-5 of their distance from the origin, squared, lies no inertia.
constexpr double kRounding = 1e-10;
/// Least share of the trace of the inertia that a moment must have: a row of particles has none about itself.
constexpr double kLeastInertia = 1e-6;

/// Inverse of a symmetric matrix, zero along axes whose eigenvalue is `least` at most.
Matrix3 pseudoInverse(const Matrix3& matrix, double least) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(matrix);
  Matrix3 inverse = Matrix3::Zero();
  for (int k = 0; k < 3; ++k) {
    const double moment = axes.eigenvalues()[k];
    if (!(moment > least)) continue;
    const Vector3 axis = axes.eigenvectors().col(k);
    inverse += 1 / moment * axis * axis.transpose();
  }
  return inverse;
}

}  // namespace

MassSpread massSpread(const ParticleStore& store, std::span<const uint32_t> members, const api::Float4* points) {
  struct Weight {
    double mass = 0;
    Vector3 place;
    void operator+=(const Weight& other) { mass += other.mass, place += other.place; }
  };
  const Weight all = sumOver<Weight>(members, [&](Weight& sum, uint32_t i) {
    sum.mass += double{store.mass()[i]};
    sum.place += double{store.mass()[i]} * vectorOf(points[i]);
  });
  MassSpread spread{all.mass, 1 / all.mass * all.place, Matrix3::Zero(), 0};
  struct Moments {
    Matrix3 matrix;  // sum of m r r^T; the inertia is its trace less itself
    double farthest2 = 0;
    void operator+=(const Moments& other) {
      matrix += other.matrix;
      farthest2 = std::max(farthest2, other.farthest2);
    }
  };
  const Moments about = sumOver<Moments>(members, [&](Moments& sum, uint32_t i) {
    const Vector3 at = vectorOf(points[i]), r = at - spread.centre;
    sum.farthest2 = std::max(sum.farthest2, at.squaredNorm());
    sum.matrix += double{store.mass()[i]} * r * r.transpose();
  });
  const Matrix3& moments = about.matrix;
  const Matrix3 inertia = moments.trace() * Matrix3::Identity() - moments;
  const double least = std::max(kRounding * spread.mass * about.farthest2, kLeastInertia * inertia.trace());
  spread.inverseInertia = pseudoInverse(inertia, least);
  spread.gyration2 = moments.trace() / spread.mass;
  return spread;
}

}  // namespace ps
