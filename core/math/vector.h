// SPDX-License-Identifier: Apache-2.0
// Linear algebra for what is few: bodies, rays, cameras, sums. It is Eigen's; whoever turns, crosses or inverts
// includes the module for it (<Eigen/Geometry>, <Eigen/LU>), which costs too much for everybody. All units must agree
// on Eigen's macros (CMakeLists.txt): nothing is vectorised, because packets add in another order and their
// multiply-adds are fused on Arm, which would show in the state hash; so nothing asks for more alignment than a double
// either. What is made without a value is zero. Loops over particles are vectorised elsewhere. Results are taken as
// Vector3, not as auto: that would keep an expression whose parts are gone.
#pragma once
#include <phasesketch/types.h>

#include <Eigen/Core>

namespace ps {

using Vector3 = Eigen::Vector3d;
using Vector4 = Eigen::Vector4d;
using Matrix3 = Eigen::Matrix3d;
using Matrix4 = Eigen::Matrix4d;
using Quaternion = Eigen::Quaternion<double>;

// The plain structs of the SDK and of the particle store.
inline Vector3 vectorOf(const api::Float4& v) { return {v.x, v.y, v.z}; }
inline Vector3 vectorOf(const api::Double3& v) { return {v.x, v.y, v.z}; }
inline api::Double3 double3Of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
/// w stays as it is.
inline void assignTo(api::Float4& to, const Vector3& v) {
  to.x = static_cast<float>(v.x()), to.y = static_cast<float>(v.y()), to.z = static_cast<float>(v.z());
}
/// Added in single precision; w stays as it is.
inline void addTo(api::Float4& to, const Vector3& v) {
  to.x += static_cast<float>(v.x()), to.y += static_cast<float>(v.y()), to.z += static_cast<float>(v.z());
}
inline api::Float4 float4Of(const Vector3& v, float w) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()), w};
}

}  // namespace ps
