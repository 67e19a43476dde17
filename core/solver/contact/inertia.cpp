// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/inertia.h"

#include "core/particles/particlestore.h"

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
  MassSpread spread{0, Vector3::Zero(), Matrix3::Zero(), 0};
  Vector3 sum = Vector3::Zero();
  for (const uint32_t i : members) {
    spread.mass += double{store.mass()[i]};
    sum += double{store.mass()[i]} * vectorOf(points[i]);
  }
  spread.centre = 1 / spread.mass * sum;
  Matrix3 moments = Matrix3::Zero();  // sum of m r r^T; the inertia is its trace less itself
  double farthest2 = 0;
  for (const uint32_t i : members) {
    const Vector3 at = vectorOf(points[i]), r = at - spread.centre;
    farthest2 = std::max(farthest2, at.squaredNorm());
    moments += double{store.mass()[i]} * r * r.transpose();
  }
  const Matrix3 inertia = moments.trace() * Matrix3::Identity() - moments;
  const double least = std::max(kRounding * spread.mass * farthest2, kLeastInertia * inertia.trace());
  spread.inverseInertia = pseudoInverse(inertia, least);
  spread.gyration2 = moments.trace() / spread.mass;
  return spread;
}

}  // namespace ps
