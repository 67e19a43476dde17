// SPDX-License-Identifier: Apache-2.0
#include "core/math/wallface.h"

#include <algorithm>
#include <cmath>

namespace ps {

WallFace WallFace::cylinder(const Vector3& point, const Vector3& axis, double radius, bool inside) {
  WallFace face = sphere(point, radius, inside);
  face.m_form = WallForm::Cylinder;
  face.m_axis = axis;
  return face;
}

WallFace WallFace::sphere(const Vector3& centre, double radius, bool inside) {
  WallFace face;
  face.m_form = WallForm::Sphere;
  face.m_centre = centre;
  face.m_radius = radius;
  face.m_side = inside ? -1 : 1;
  return face;
}

bool WallFace::operator==(const WallFace& other) const {
  if (m_form != other.m_form) return false;
  if (!isCurved()) return m_plane.normal == other.m_plane.normal && m_plane.offset == other.m_plane.offset;
  return m_centre == other.m_centre && m_axis == other.m_axis && m_radius == other.m_radius && m_side == other.m_side;
}

WallFace WallFace::before(double inset) const {
  WallFace face = *this;
  face.m_plane.offset += inset;
  face.m_radius = std::max(0.0, m_radius + m_side * inset);
  return face;
}

Vector3 WallFace::fromMiddle(const Vector3& place) const {
  const Vector3 apart = place - m_centre;
  return apart - m_axis.dot(apart) * m_axis;
}

double WallFace::heightOfCurved(const Vector3& place) const { return m_side * (fromMiddle(place).norm() - m_radius); }

Plane WallFace::at(const Vector3& place) const {
  if (!isCurved()) return m_plane;
  Vector3 out = fromMiddle(place);
  const double distance = out.norm();
  if (distance > 0) {
    out /= distance;
  } else {
    int least = 0;  // the axis of the scene that is most across the cylinder's
    m_axis.cwiseAbs().minCoeff(&least);
    out[least] = 1;
    out -= m_axis.dot(out) * m_axis;
    out.normalize();
  }
  const Vector3 normal = m_side * out;
  return {normal, normal.dot(place) - m_side * (distance - m_radius)};
}

std::optional<double> WallFace::meets(const Vector3& place, const Vector3& way) const {
  if (!isCurved()) {
    const double towards = -m_plane.normal.dot(way);
    if (!(towards > 0)) return std::nullopt;
    return std::max(0.0, m_plane.heightOf(place) / towards);
  }
  // |apart + t across| = radius: from inside the later one of the two times, from outside the earlier one.
  const Vector3 apart = fromMiddle(place), across = way - m_axis.dot(way) * m_axis;
  const double a = across.squaredNorm(), b = apart.dot(across), c = apart.squaredNorm() - m_radius * m_radius;
  if (!(a > 0)) return std::nullopt;
  const double square = b * b - a * c;
  if (isInside()) {
    if (!(square > 0)) return b > 0 ? std::optional(0.0) : std::nullopt;  // it is behind the wall
    const double root = std::sqrt(square);
    // Without the difference of what is nearly equal.
    const double time = b > 0 ? -c / (b + root) : (root - b) / a;
    return std::max(0.0, time);
  }
  if (!(b < 0) || !(square > 0)) return std::nullopt;
  return std::max(0.0, c / (std::sqrt(square) - b));
}

}  // namespace ps
