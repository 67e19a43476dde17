// SPDX-License-Identifier: Apache-2.0
#include "core/scene/solidform.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace ps {
namespace {

constexpr double kPi = std::numbers::pi;
/// Share of its box from which the triangles of a mesh enclose something whose middle means anything.
constexpr double kLeastEnclosed = 1e-3;

SolidForm::Kind kindOf(std::string_view name) {
  uint8_t kind = 0;
  std::string_view rest = kSolidKinds;
  while (!rest.empty()) {
    const size_t bar = std::min(rest.find('|'), rest.size());
    if (rest.substr(0, bar) == name) return static_cast<SolidForm::Kind>(kind);
    rest.remove_prefix(std::min(bar + 1, rest.size()));
    ++kind;
  }
  return SolidForm::Kind::Ellipsoid;
}

double square(double x) { return x * x; }

/// m3 of a ring around y whose tube is round: from slices across y, which may overlap in the middle. Simpson's rule in
/// the angle along the tube.
double torusVolume(double width, double thickness) {
  const double tube = thickness / 2, ring = width / 2 - tube;
  constexpr int kSlices = 256;
  double sum = 0;
  for (int k = 0; k <= kSlices; ++k) {
    const double angle = kPi * k / kSlices, half = tube * std::sin(angle);
    const double slice = kPi * (square(ring + half) - square(std::max(0.0, ring - half))) * tube * std::sin(angle);
    sum += slice * (k == 0 || k == kSlices ? 1 : k % 2 == 1 ? 4 : 2);
  }
  return sum * kPi / kSlices / 3;
}

/// Half axes of the lower half ellipsoids that a bowl is between, about the middle of its rim; m.
struct BowlAxes {
  Vector3 outer, inner;  ///< no inner ones where the wall fills it
};
BowlAxes bowlAxes(const Vector3& size, double wall) {
  const Vector3 outer(size[0] / 2, size[1], size[2] / 2), inner = outer - Vector3::Constant(wall);
  return {outer, inner.minCoeff() > 0 ? inner : Vector3(Vector3::Zero())};
}

Vector3 pointOf(const SceneMesh& mesh, uint32_t index) {
  const auto& p = mesh.points[index];
  return {p[0], p[1], p[2]};
}

}  // namespace

SolidForm::SolidForm(const SolidShape& shape) : m_mesh(shape.mesh) {
  const api::ParameterList list = solidParameters();
  const auto number = [&](const std::string& key) { return numberOf(shape.parameters, list, key.c_str()); };
  const auto three = [&](const std::string& what) {
    return Vector3(number(what + "_x"), number(what + "_y"), number(what + "_z"));
  };
  m_kind = kindOf(choiceOf(shape.parameters, list, "kind"));
  m_size = three("size");
  m_middle = three("position");
  m_isHollow = m_kind == Kind::Mesh && choiceOf(shape.parameters, list, "inside") == "hollow";
  m_wall = number("wall");
  if (m_kind == Kind::Rope) {
    const auto count = static_cast<int>(number("points"));
    m_thickness = m_size[1];
    m_size.setZero();
    for (int k = 1; k <= count; ++k) {
      m_points.push_back(three("point_" + std::to_string(k)));
      m_size = m_size.cwiseMax(2 * m_points.back().cwiseAbs());
    }
    m_size += Vector3::Constant(m_thickness);
  }
  const std::string held = choiceOf(shape.parameters, list, "held");
  m_heldEnds = !isThin() || held == "none" ? 0 : held == "start" ? 1 : 2;
  m_rotation = three("rotation");
  const Vector3 angle = m_rotation * kPi / 180;
  m_axes = isTurned()
               ? Matrix3((Eigen::AngleAxisd(angle[2], Vector3::UnitZ()) *
                          Eigen::AngleAxisd(angle[1], Vector3::UnitY()) * Eigen::AngleAxisd(angle[0], Vector3::UnitX()))
                             .toRotationMatrix())
               : Matrix3(Matrix3::Identity());
}

bool SolidForm::holds(const Vector3& own) const {
  const Vector3 r = own.cwiseQuotient(m_size) * 2;  // -1..1 across the shape
  if ((r.array().abs() > 1).any()) return false;
  const double across = r[0] * r[0] + r[2] * r[2];
  switch (m_kind) {
    case Kind::Block:
    case Kind::Sheet:
      return true;
    case Kind::Ellipsoid:
      return r.squaredNorm() <= 1;
    case Kind::Cylinder:
      return across <= 1;
    case Kind::Cone:
      return across <= square((1 - r[1]) / 2);
    case Kind::Capsule: {
      const double cap = std::min({m_size[0], m_size[1], m_size[2]}) / 2;  // along y
      const double beyond = std::max(0.0, std::abs(own[1]) - (m_size[1] / 2 - cap)) / cap;
      return across + beyond * beyond <= 1;
    }
    case Kind::Torus: {
      const double tube = std::min(m_size[1], m_size[0]) / 2, ring = m_size[0] / 2 - tube;
      return square(std::hypot(own[0], own[2] * m_size[0] / m_size[2]) - ring) +
                 square(own[1] * tube * 2 / m_size[1]) <=
             tube * tube;
    }
    case Kind::Tube: {
      const double x = m_size[0] / 2 - m_wall, z = m_size[2] / 2 - m_wall;
      return across <= 1 && (x <= 0 || z <= 0 || square(own[0] / x) + square(own[2] / z) >= 1);
    }
    case Kind::Bowl: {
      const auto [outer, inner] = bowlAxes(m_size, m_wall);
      const Vector3 fromRim = own - m_size[1] / 2 * Vector3::UnitY();
      return fromRim.cwiseQuotient(outer).squaredNorm() <= 1 &&
             (inner.isZero() || fromRim.cwiseQuotient(inner).squaredNorm() >= 1);
    }
    case Kind::Rope: {
      for (size_t k = 0; k + 1 < m_points.size(); ++k) {
        const Vector3 line = m_points[k + 1] - m_points[k], from = own - m_points[k];
        const double square = line.squaredNorm(),
                     share = square > 0 ? std::clamp(from.dot(line) / square, 0.0, 1.0) : 0;
        if ((from - share * line).norm() <= m_thickness / 2) return true;
      }
      return false;
    }
    case Kind::Mesh:
      break;
  }
  return false;
}

Vector3 SolidForm::centroid() const {
  if (m_kind == Kind::Cone) return {0, -m_size[1] / 4, 0};
  if (m_kind == Kind::Bowl) {
    const auto [outer, inner] = bowlAxes(m_size, m_wall);
    constexpr double kBelow = 3.0 / 8;  // of a half ball's radius, from its flat side to its middle
    const double moment = outer.prod() * outer[1] - inner.prod() * inner[1];
    return {0, m_size[1] / 2 - kBelow * moment / (outer.prod() - inner.prod()), 0};
  }
  if (m_kind == Kind::Rope) {
    Vector3 moment;
    double length = 0;
    for (size_t k = 1; k < m_points.size(); ++k) {
      const double piece = (m_points[k] - m_points[k - 1]).norm();
      moment += piece / 2 * (m_points[k] + m_points[k - 1]);
      length += piece;
    }
    return length > 0 ? Vector3(moment / length) : m_points.front();
  }
  if (m_kind != Kind::Mesh || !m_mesh) return Vector3::Zero();
  const MeshBounds bounds = boundsOf(*m_mesh);
  const Vector3 extent = bounds.maximum - bounds.minimum, middle = 0.5 * (bounds.minimum + bounds.maximum);
  Vector3 moment;
  double volume = 0;
  for (const auto& t : m_mesh->triangles) {
    const Vector3 a = pointOf(*m_mesh, t[0]) - middle, b = pointOf(*m_mesh, t[1]) - middle,
                  c = pointOf(*m_mesh, t[2]) - middle;
    const double tetrahedron = a.dot(b.cross(c)) / 6;
    moment += tetrahedron / 4 * (a + b + c);
    volume += tetrahedron;
  }
  if (!(std::abs(volume) > kLeastEnclosed * extent.prod())) return Vector3::Zero();
  return (moment / volume).cwiseQuotient(extent).cwiseProduct(m_size).cwiseMax(-m_size / 2).cwiseMin(m_size / 2);
}

bool SolidForm::isHeld(const Vector3& own, double spacing) const {
  if (m_heldEnds == 0) return false;
  if (m_kind == Kind::Sheet) {
    const double fromStart = own[2] + m_size[2] / 2;
    return fromStart < spacing || (m_heldEnds == 2 && m_size[2] - fromStart < spacing);
  }
  const auto isAt = [&](const Vector3& point) { return (own - point).norm() < spacing / 2; };
  return isAt(m_points.front()) || (m_heldEnds == 2 && isAt(m_points.back()));
}

double SolidForm::volume(double layer) const {
  const double box = m_size.prod(), disc = kPi / 4 * box;
  switch (m_kind) {
    case Kind::Block:
      return box;
    case Kind::Ellipsoid:
      return kPi / 6 * box;
    case Kind::Cylinder:
      return disc;
    case Kind::Cone:
      return disc / 3;
    case Kind::Capsule: {
      const double caps = m_size.minCoeff();
      return kPi / 4 * m_size[0] * m_size[2] * (m_size[1] - caps + 2.0 / 3 * caps);
    }
    case Kind::Torus: {
      const double thickness = std::min(m_size[1], m_size[0]);
      return torusVolume(m_size[0], thickness) * m_size[1] / thickness * m_size[2] / m_size[0];
    }
    case Kind::Tube: {
      const double x = std::max(0.0, m_size[0] - 2 * m_wall), z = std::max(0.0, m_size[2] - 2 * m_wall);
      return kPi / 4 * m_size[1] * (m_size[0] * m_size[2] - x * z);
    }
    case Kind::Bowl: {
      const auto [outer, inner] = bowlAxes(m_size, m_wall);
      return 2 * kPi / 3 * (outer.prod() - inner.prod());
    }
    case Kind::Sheet:
      return m_size[0] * m_size[2] * layer;
    case Kind::Rope: {
      double length = 0;
      for (size_t k = 0; k + 1 < m_points.size(); ++k) length += (m_points[k + 1] - m_points[k]).norm();
      return length * layer * layer;
    }
    case Kind::Mesh:
      break;
  }
  if (!m_mesh) return 0;
  const MeshBounds bounds = boundsOf(*m_mesh);
  const Vector3 extent = bounds.maximum - bounds.minimum;
  if (m_isHollow)
    return layer * areaOf(*m_mesh, (extent.array() > 0).select(m_size.array() / extent.array(), 1.0).matrix());
  return extent.minCoeff() > 0 ? std::abs(signedVolume(*m_mesh)) * m_size.cwiseQuotient(extent).prod() : 0;
}

MeshBounds boundsOf(const SceneMesh& mesh) {
  if (mesh.points.empty()) return {};
  MeshBounds bounds{pointOf(mesh, 0), pointOf(mesh, 0)};
  for (uint32_t i = 1; i < mesh.points.size(); ++i) {
    bounds.minimum = bounds.minimum.cwiseMin(pointOf(mesh, i));
    bounds.maximum = bounds.maximum.cwiseMax(pointOf(mesh, i));
  }
  return bounds;
}

std::string problemOf(const SceneMesh& mesh) {
  for (size_t i = 0; i < mesh.points.size(); ++i) {
    for (const float c : mesh.points[i]) {
      if (!std::isfinite(c)) return "point " + std::to_string(i) + " is no place in space";
    }
  }
  for (size_t k = 0; k < mesh.triangles.size(); ++k) {
    for (const uint32_t i : mesh.triangles[k]) {
      if (i >= mesh.points.size()) return "triangle " + std::to_string(k) + " has a corner that does not exist";
    }
  }
  return {};
}

double areaOf(const SceneMesh& mesh, const Vector3& scale) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = pointOf(mesh, t[0]);
    const Vector3 ab = scale.cwiseProduct(pointOf(mesh, t[1]) - a), ac = scale.cwiseProduct(pointOf(mesh, t[2]) - a);
    sum += ab.cross(ac).norm();
  }
  return sum / 2;
}

double signedVolume(const SceneMesh& mesh) {
  if (mesh.points.empty()) return 0;
  const Vector3 origin = pointOf(mesh, 0);  // near the mesh: what lies far away loses its digits
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = pointOf(mesh, t[0]) - origin, b = pointOf(mesh, t[1]) - origin, c = pointOf(mesh, t[2]) - origin;
    sum += a.dot(b.cross(c));
  }
  return sum / 6;
}

}  // namespace ps
