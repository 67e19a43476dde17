// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/pose.h"

#include <cmath>

#include <Eigen/Geometry>

namespace ps::scripted {
namespace {

Eigen::Quaternionf toEigen(const XrQuaternionf& q) { return {q.w, q.x, q.y, q.z}; }
Eigen::Vector3f toEigen(const XrVector3f& v) { return {v.x, v.y, v.z}; }
XrQuaternionf fromEigen(const Eigen::Quaternionf& q) { return {q.x(), q.y(), q.z(), q.w()}; }
XrVector3f fromEigen(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

XrVector3f rotated(const XrQuaternionf& turn, const XrVector3f& vector) {
  const Eigen::Vector3f result = toEigen(turn) * toEigen(vector);
  return fromEigen(result);
}

XrPosef combined(const XrPosef& outer, const XrPosef& inner) {
  const XrVector3f step = rotated(outer.orientation, inner.position);
  return {fromEigen((toEigen(outer.orientation) * toEigen(inner.orientation)).normalized()),
          {outer.position.x + step.x, outer.position.y + step.y, outer.position.z + step.z}};
}

XrPosef inverse(const XrPosef& pose) {
  const XrQuaternionf back = fromEigen(toEigen(pose.orientation).conjugate());
  const XrVector3f step = rotated(back, pose.position);
  return {back, {-step.x, -step.y, -step.z}};
}

XrPosef between(const XrPosef& a, const XrPosef& b, float t) {
  const Eigen::Vector3f from = toEigen(a.position), to = toEigen(b.position);
  const Eigen::Vector3f position = from + t * (to - from);
  return {fromEigen(toEigen(a.orientation).slerp(t, toEigen(b.orientation))), fromEigen(position)};
}

bool isUnit(const XrQuaternionf& turn) { return std::abs(toEigen(turn).norm() - 1.0f) < 0.01f; }

XrVector3f rotationVector(const XrQuaternionf& turn) {
  const Eigen::AngleAxisf rotation(toEigen(turn));
  const float angle = rotation.angle() > float(M_PI) ? rotation.angle() - 2 * float(M_PI) : rotation.angle();
  const Eigen::Vector3f result = angle * rotation.axis();
  return fromEigen(result);
}

}  // namespace ps::scripted
