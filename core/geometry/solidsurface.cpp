// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/solidsurface.h"

#include "core/geometry/meshrepair.h"
#include "core/geometry/solidfacets.h"
#include "core/math/meshnearest.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

using Kind = SolidForm::Kind;
constexpr int kAround = 96, kArc = 48;  ///< facets of an oval solid: round its axis, and round its rim or caps
constexpr double kStraight = 0.999999;  ///< of a cosine
constexpr double kOnSurface = 1e-9;  ///< of the solid's size: nearer than that, the surface itself says where it faces

bool isRound(const SolidForm& form) {
  const Vector3& size = form.size();
  return std::abs(size[0] - size[2]) <= kOnSurface * size[0];
}

}  // namespace

SolidSurface::SolidSurface(const SolidShape& shape) : m_inside(shape) {
  if (form().kind() == Kind::Block) {
    m_way = Way::Block;
  } else if (isEllipsoid(form())) {
    m_way = Way::Ellipsoid;
  } else if (form().kind() == Kind::Mesh) {
    m_way = Way::Mesh;
    if (!shape.mesh || shape.mesh->triangles.empty()) return;
    m_closed = factsOf(*shape.mesh).closed();
    m_mesh = std::make_shared<const MeshNearest>(facetsOf(*shape.mesh, form().size()));
  } else if (isRound(form())) {
    m_way = Way::Round;
    takeRound();
  } else {
    m_way = Way::Mesh;
    takeOval();
  }
}

SolidSurface::~SolidSurface() = default;

void SolidSurface::takeRound() {
  const double radius = form().size()[0] / 2, half = form().size()[1] / 2;
  if (form().kind() == Kind::Capsule) {
    m_profile.push_back({{0, radius - half}, {0, half - radius}});
    m_swell = radius;
  } else if (form().kind() == Kind::Torus) {
    m_profile.push_back({{radius - half, 0}, {radius - half, 0}});
    m_swell = half;
  } else {
    const std::vector<SolidRim> outline = outlineOf(form(), kAround);
    for (size_t k = 0; k + 1 < outline.size(); ++k) {
      if (outline[k].x == 0 && outline[k + 1].x == 0) continue;  // through the foot of a bowl, which is no surface
      m_profile.push_back({{outline[k].x, outline[k].y}, {outline[k + 1].x, outline[k + 1].y}});
    }
  }
}

void SolidSurface::takeOval() { m_mesh = std::make_shared<const MeshNearest>(facetsAround(form(), kAround, kArc)); }

SolidSurface::Near SolidSurface::at(const Vector3& own) const {
  switch (m_way) {
    case Way::Block:
      return nearBlock(own);
    case Way::Ellipsoid:
      return nearEllipsoid(own);
    case Way::Round:
      return nearRound(own);
    case Way::Mesh:
      break;
  }
  return nearMesh(own);
}

SolidSurface::Near SolidSurface::nearBlock(const Vector3& own) const {
  const Vector3 beyond = own.cwiseAbs() - form().size() / 2, outside = beyond.cwiseMax(0.0);
  const auto side = [&](Eigen::Index a) { return own[a] < 0 ? -1.0 : 1.0; };
  if (const double distance = outside.norm(); distance > 0) {
    Vector3 normal = outside / distance;
    for (Eigen::Index a = 0; a < 3; ++a) normal[a] *= side(a);
    return {distance, normal};
  }
  Eigen::Index axis = 0;
  const double distance = beyond.maxCoeff(&axis);
  return {distance, side(axis) * Vector3::Unit(axis)};
}

/// The nearest place is e_i^2 y_i / (t + e_i^2), with the one root t > -e_min^2 of sum (e_i y_i / (t + e_i^2))^2 = 1:
/// Eberly 2013, "Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid", eq. 11 and 12. The sum is
/// convex: from where it is too large, Newton's steps come to the root from one side.
SolidSurface::Near SolidSurface::nearEllipsoid(const Vector3& own) const {
  constexpr int kSteps = 60;
  const Vector3 e = form().size() / 2, square = e.cwiseProduct(e);
  const Vector3 y = own.cwiseAbs().cwiseMax(kOnSurface * e);  // in a plane of symmetry, a hair beside it
  const Vector3 ey = e.cwiseProduct(y);
  double t = (ey - square).maxCoeff();
  for (int k = 0; k < kSteps; ++k) {
    const Vector3 below = square + Vector3::Constant(t), share = ey.cwiseQuotient(below);
    const double sum = share.squaredNorm(), slope = -2 * share.cwiseProduct(share).cwiseQuotient(below).sum();
    const double next = t - (sum - 1) / slope;
    if (!(next > t)) break;
    t = next;
  }
  const Vector3 on = square.cwiseProduct(y).cwiseQuotient(square + Vector3::Constant(t));
  Vector3 normal = on.cwiseQuotient(square).normalized();
  for (Eigen::Index a = 0; a < 3; ++a) {
    if (own[a] < 0) normal[a] = -normal[a];
  }
  return {(t < 0 ? -1 : 1) * (y - on).norm(), normal};
}

SolidSurface::Near SolidSurface::nearRound(const Vector3& own) const {
  using Vector2 = Eigen::Vector2d;
  const double across = std::hypot(own[0], own[2]);
  const Vector2 p(across, own[1]);
  Vector2 on(0, 0), along(0, 0);
  double squared = HUGE_VAL;
  for (const Segment& s : m_profile) {
    const Vector2 line = s.b - s.a;
    const double length2 = line.squaredNorm();
    const double share = length2 > 0 ? std::clamp((p - s.a).dot(line) / length2, 0.0, 1.0) : 0;
    const Vector2 q = s.a + share * line;
    if (const double one = (p - q).squaredNorm(); one < squared) squared = one, on = q, along = line;
  }
  const double distance = std::sqrt(squared);
  const double sign = m_swell > 0 || !form().holds(own) ? 1 : -1;
  Vector2 normal = sign * (p - on);
  if (distance > kOnSurface * form().size()[1])
    normal /= distance;
  else
    normal = m_swell > 0 ? Vector2(1, 0) : Vector2(Vector2(-along[1], along[0]).normalized());
  const double x = across > 0 ? own[0] / across : 1, z = across > 0 ? own[2] / across : 0;
  return {sign * distance - m_swell, Vector3(normal[0] * x, normal[1], normal[0] * z)};
}

SolidSurface::Near SolidSurface::nearMesh(const Vector3& own) const {
  if (!m_mesh) return {own.norm(), Vector3::UnitY()};  // a mesh without triangles: nothing but its middle
  const MeshNearest::Hit hit = m_mesh->at(own);
  const double distance = std::sqrt(hit.squared), along = (own - hit.place).dot(hit.normal);
  // Straight over a triangle of a closed mesh, that tells the side; at edges, and near holes, what it winds around
  // does.
  const bool straight = m_closed && std::abs(along) > kStraight * distance;
  const double sign = (straight ? along < 0 : m_inside.holds(own)) ? -1 : 1;
  if (distance > kOnSurface * form().size().norm()) return {sign * distance, sign * (own - hit.place) / distance};
  return {sign * distance, hit.normal};
}

}  // namespace ps
