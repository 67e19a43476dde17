// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/plane.h"

#include <optional>

namespace ps {

/// What the face of a wall is: an endless plane, the mantle of an endless cylinder, a sphere.
enum class WallForm { Plane, Cylinder, Sphere };

/// The face of a wall. What is curved has matter inside, as a pipe or a bowl, or outside, as a pillar or a ball.
class WallFace {
 public:
  /// The plane y = 0 with matter above.
  WallFace() : m_plane{Vector3(0, 1, 0), 0} {}
  explicit WallFace(const Plane& plane) : m_plane(plane) {}
  /// About an axis through `point` m, a unit vector; `radius` in m.
  static WallFace cylinder(const Vector3& point, const Vector3& axis, double radius, bool inside);
  static WallFace sphere(const Vector3& centre, double radius, bool inside);
  bool operator==(const WallFace& other) const;

  /// The face `inset` m before this one, towards the matter; at most its middle.
  WallFace before(double inset) const;
  WallForm form() const { return m_form; }
  bool isCurved() const { return m_form != WallForm::Plane; }
  bool isInside() const { return m_side < 0; }        ///< of what is curved: whether matter is inside
  const Plane& plane() const { return m_plane; }      ///< of a plane
  const Vector3& centre() const { return m_centre; }  ///< m; of a cylinder some point on its axis
  const Vector3& axis() const { return m_axis; }      ///< unit vector of a cylinder; zero of a sphere
  double radius() const { return m_radius; }          ///< m
  /// m; negative behind the wall.
  double heightOf(const Vector3& place) const { return isCurved() ? heightOfCurved(place) : m_plane.heightOf(place); }
  /// The plane that touches the face where it is nearest to a place, above it the matter's side: heightOf() of it is
  /// that of the face there. On the axis, or in the centre, one of all directions.
  Plane at(const Vector3& place) const;
  /// After how many times `way` what goes on straight from a place before the wall comes through it, 0 where it is
  /// behind it and goes on; none where it never does.
  std::optional<double> meets(const Vector3& place, const Vector3& way) const;

 private:
  /// m, from the centre, or straight from the axis.
  Vector3 fromMiddle(const Vector3& place) const;
  double heightOfCurved(const Vector3& place) const;

  WallForm m_form = WallForm::Plane;
  Plane m_plane;
  Vector3 m_centre, m_axis;
  double m_radius = 0, m_side = 1;  ///< side: 1 matter outside, -1 inside
};

}  // namespace ps
