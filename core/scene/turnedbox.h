// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/scene/pose.h"

namespace ps {

/// Degrees about the scene's x, then y, then z axis that make up a turn, and the turn that they make.
Vector3 anglesOf(const Matrix3& turn);
Quaternion turnOf(const Vector3& degrees);

/// A box as it stands in the scene. A drain is turned about its own middle by the degrees that its parameters say;
/// probes' regions and pins stand along the axes, and are never turned. To ask where many places are, make one of it.
class TurnedBox {
 public:
  explicit TurnedBox(const Region& region) : TurnedBox(region.minimum, region.maximum, Vector3::Zero()) {}
  explicit TurnedBox(const Sink& sink);

  bool isTurned() const { return m_rotation != Vector3::Zero(); }
  Vector3 middle() const { return 0.5 * (m_minimum + m_maximum); }  ///< m
  Vector3 size() const { return m_maximum - m_minimum; }            ///< m, along its own axes
  const Matrix3& axes() const { return m_axes; }                    ///< its own, as columns
  bool contains(const Vector3& place) const;                        ///< its faces included
  /// m; bit a of `corner` set: at the far end of its own axis a, 0 x.
  Vector3 corner(int corner) const;
  BodyBounds bounds() const;  ///< around it, along the scene's axes

  void go(const RigidMove& move);
  void resize(const Vector3& size, const Vector3& middle);  ///< m
  void putInto(Region& region) const;                       ///< of one that is not turned
  void putInto(Sink& sink) const;

 private:
  TurnedBox(const Vector3& minimum, const Vector3& maximum, const Vector3& rotation);
  Vector3 m_minimum, m_maximum;  ///< m, before it is turned
  Vector3 m_rotation;            ///< degrees about x, then y, then z
  Matrix3 m_axes = Matrix3::Identity();
};

/// A drain that is taken along, or a region that is shifted.
template <class Box>
Box carried(Box box, const RigidMove& move) {
  TurnedBox there(box);
  there.go(move);
  there.putInto(box);
  return box;
}

}  // namespace ps
