// SPDX-License-Identifier: Apache-2.0
#include "core/geometry/solidfacets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

using Kind = SolidForm::Kind;
constexpr double kPi = std::numbers::pi;
constexpr int kLeastAround = 96, kMostAround = 720;  ///< facets

std::vector<MeshNearest::Triangle> facetsOfBlock(const Vector3& size) {
  std::vector<MeshNearest::Triangle> triangles;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (const double side : {-0.5, 0.5}) {
      const Eigen::Index u = (axis + (side > 0 ? 1 : 2)) % 3, v = (axis + (side > 0 ? 2 : 1)) % 3;
      const auto corner = [&](double alongU, double alongV) {
        Vector3 p;
        p[axis] = side * size[axis], p[u] = alongU * size[u], p[v] = alongV * size[v];
        return p;
      };
      const Vector3 a = corner(-0.5, -0.5), b = corner(0.5, -0.5), c = corner(0.5, 0.5), d = corner(-0.5, 0.5);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return triangles;
}

/// From the inner rim over the outer one down to the foot, and up again inside; `axes` of the outer half ellipsoid, m.
std::vector<SolidRim> bowlOutline(const Vector3& axes, double wall, int arc) {
  const double top = axes[1] / 2;
  const Vector3 inner = axes - Vector3::Constant(wall);
  const bool isFull = !(inner.minCoeff() > 0);
  std::vector<SolidRim> outline{isFull ? SolidRim{0, top, 0} : SolidRim{inner[0], top, inner[2]}};
  const auto add = [&](const Vector3& e, int k) {
    const double angle = kPi / 2 * k / arc, out = k == arc ? 0 : std::cos(angle);
    outline.push_back({e[0] * out, top - e[1] * std::sin(angle), e[2] * out});
  };
  for (int k = 0; k <= arc; ++k) add(axes, k);
  for (int k = arc; k >= 0 && !isFull; --k) add(inner, k);
  return outline;
}

}  // namespace

bool isEllipsoid(const SolidForm& form) {
  const Vector3& size = form.size();
  switch (form.kind()) {
    case Kind::Ellipsoid:
      return true;
    case Kind::Capsule:
      return size[1] <= std::min(size[0], size[2]);
    case Kind::Torus:
      return size[1] >= size[0];
    default:
      return false;
  }
}

std::vector<SolidRim> outlineOf(const SolidForm& form, int arc) {
  const double x = form.size()[0] / 2, y = form.size()[1] / 2, z = form.size()[2] / 2;
  std::vector<SolidRim> outline;
  if (isEllipsoid(form) || form.kind() == Kind::Capsule) {
    const double cap = isEllipsoid(form) ? y : std::min({x, y, z});
    for (int k = 0; k <= arc; ++k) {
      const double angle = kPi * k / arc, out = k == 0 || k == arc ? 0 : std::sin(angle), up = cap * std::cos(angle);
      outline.push_back({x * out, up + (2 * k < arc ? y - cap : cap - y), z * out});
    }
    return outline;
  }
  switch (form.kind()) {
    case Kind::Cone:
      return {{0, y, 0}, {x, -y, z}, {0, -y, 0}};
    case Kind::Tube:
      if (const double wall = form.wall(); wall < std::min(x, z))
        return {{x - wall, y, z - wall}, {x, y, z}, {x, -y, z}, {x - wall, -y, z - wall}, {x - wall, y, z - wall}};
      break;
    case Kind::Bowl:
      return bowlOutline({x, 2 * y, z}, form.wall(), (arc + 1) / 2);
    case Kind::Torus: {
      const double ring = x - y;  // the tube is as thick as it is high
      for (int k = 0; k <= arc; ++k) {
        const double angle = -2 * kPi * k / arc, out = ring + y * std::cos(angle);
        outline.push_back({out, y * std::sin(angle), out * z / x});
      }
      return outline;
    }
    default:
      break;
  }
  return {{0, y, 0}, {x, y, z}, {x, -y, z}, {0, -y, 0}};
}

std::vector<MeshNearest::Triangle> facetsAround(const SolidForm& form, int around, int arc) {
  const std::vector<SolidRim> outline = outlineOf(form, arc);
  std::vector<MeshNearest::Triangle> triangles;
  const auto at = [&](const SolidRim& rim, int turn) {
    const double angle = 2 * kPi * (turn % around) / around;
    return Vector3(rim.x * std::cos(angle), rim.y, rim.z * std::sin(angle));
  };
  for (size_t k = 0; k + 1 < outline.size(); ++k) {
    const SolidRim &from = outline[k], &to = outline[k + 1];
    for (int turn = 0; turn < around; ++turn) {
      const Vector3 a = at(from, turn), b = at(from, turn + 1), c = at(to, turn), d = at(to, turn + 1);
      if (from.x > 0) triangles.push_back({a, b, c});
      if (to.x > 0) triangles.push_back({b, d, c});
    }
  }
  return triangles;
}

std::vector<MeshNearest::Triangle> facetsOf(const SceneMesh& mesh, const Vector3& size) {
  const MeshBounds bounds = boundsOf(mesh);
  const Vector3 extent = bounds.maximum - bounds.minimum, middle = (bounds.minimum + bounds.maximum) / 2;
  Vector3 scale;
  for (size_t a = 0; a < 3; ++a) scale[a] = extent[a] > 0 ? size[a] / extent[a] : 0;
  std::vector<MeshNearest::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& corners : mesh.triangles) {
    MeshNearest::Triangle triangle;
    for (size_t k = 0; k < 3; ++k) {
      const auto& p = mesh.points[corners[k]];
      triangle[k] = scale.cwiseProduct(Vector3(p[0], p[1], p[2]) - middle);
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

/// A chord of an arc of the angle 2 pi/n misses the circle by R (1 - cos(pi/n)), about R (pi/n)^2/2.
std::vector<MeshNearest::Triangle> facetsOf(const SolidShape& shape, double error) {
  const SolidForm form(shape);
  if (form.kind() == Kind::Block) return facetsOfBlock(form.size());
  if (form.kind() == Kind::Mesh) {
    if (!shape.mesh) return {};
    return facetsOf(*shape.mesh, form.size());
  }
  Vector3 round = form.size();
  if (form.kind() == Kind::Bowl) round[1] *= 2;  // half of what its arcs belong to
  const double wanted = kPi * std::sqrt(round.maxCoeff() / (4 * error));
  const int around = wanted < kMostAround ? std::max(kLeastAround, static_cast<int>(std::ceil(wanted))) : kMostAround;
  return facetsAround(form, around, around / 2);
}

}  // namespace ps
