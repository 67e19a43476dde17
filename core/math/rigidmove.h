// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

#include <Eigen/Geometry>

namespace ps {

/// A turn about the origin and a shift after it: what is at p goes to turn p + shift.
struct RigidMove {
  Quaternion turn = Quaternion::Identity();  ///< of unit length
  Vector3 shift{0, 0, 0};                    ///< m

  Vector3 of(const Vector3& p) const { return turns() ? Vector3(turn * p + shift) : Vector3(p + shift); }
  bool turns() const { return turn.vec() != Vector3::Zero(); }
  bool isNothing() const { return !turns() && shift == Vector3::Zero(); }
  /// This one after another.
  RigidMove after(const RigidMove& first) const { return {(turn * first.turn).normalized(), of(first.shift)}; }
  RigidMove inverse() const { return {turn.conjugate(), turns() ? Vector3(turn.conjugate() * -shift) : -shift}; }
  static RigidMove about(const Vector3& pivot, const Quaternion& turn) { return {turn, pivot - turn * pivot}; }
};

}  // namespace ps
