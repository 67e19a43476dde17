// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/truesurface.h"

#include "core/base/hash.h"
#include "core/base/parallel.h"
#include "core/geometry/meshrepair.h"
#include "core/geometry/solidfacets.h"
#include "core/geometry/solidsurface.h"
#include "core/solver/truesurface.h"

#include <cmath>
#include <string>

namespace ps {
namespace {

api::Float4* fieldOf(ParticleStore& store) {
  return static_cast<api::Float4*>(store.find(field::kTrueSurface, api::FieldType::Float4));
}

/// How deep below a face the outermost layer of a block's lattice lies at least, in spacings: nearer to it, and the
/// spheres that single solids are swept against would stand out of it (SweptClamp).
constexpr double kLeastDepth = 0.455;
/// How far from a shape its facets may lie, in spacings.
constexpr double kFacetError = 0.01;

uint64_t stampOf(const SolidShape& solid) {
  Hash hash;
  const api::ParameterList list = solidParameters();
  for (size_t k = 0; k < list.count; ++k) {
    const Value value = valueOf(solid.parameters, list[k]);
    if (const auto* number = std::get_if<double>(&value)) hash.add(*number);
    if (const auto* name = std::get_if<std::string>(&value)) hash.add(name->data(), name->size());
  }
  if (solid.mesh) {
    hash.add(solid.mesh->points.data(), std::span(solid.mesh->points).size_bytes());
    hash.add(solid.mesh->triangles.data(), std::span(solid.mesh->triangles).size_bytes());
  }
  return hash.value();
}

bool isTurnedBlock(const SolidShape& solid) {
  const SolidForm form(solid);
  return form.kind() == SolidForm::Kind::Block && form.isTurned();
}

/// Whether a particle of a block is in the outermost layer of one face and of no other: across an edge tangent planes
/// would be blended to a bevel, where those of a lattice are round. What is one layer thick has two faces there.
bool isInOneFace(const SolidForm& block, const Vector3& own, double spacing) {
  int faces = 0;
  for (Eigen::Index a = 0; a < 3; ++a) {
    const double size = block.size()[a], depth = size / 2 - std::abs(own[a]);
    if (!(depth < spacing)) continue;
    if (depth < kLeastDepth * spacing || layersAlong(size, spacing) < 2) return false;
    ++faces;
  }
  return faces == 1;
}

}  // namespace

bool hasTrueSurface(const Body& body) {
  const auto* solid = std::get_if<SolidShape>(&body.shape);
  return solid && toggleOf(body.parameters, bodyParameters(), "fixed") &&
         (isPacked(*solid, true) || isTurnedBlock(*solid)) && body.velocity == Vector3::Zero() &&
         body.spin == Vector3::Zero();
}

void noteTrueSurface(ParticleStore& store, std::span<const uint32_t> ids, const Body& body, double spacing) {
  store.declare(field::kTrueSurface, api::FieldType::Float4, "m", "normal and depth of the surface of a fixed shape");
  api::Float4* noted = fieldOf(store);
  const SolidSurface surface(std::get<SolidShape>(body.shape));
  const SolidForm& form = surface.form();
  const bool isBlock = form.kind() == SolidForm::Kind::Block;
  forChunks(ids.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const size_t i = store.indexOf(ids[k]);
      const Vector3 own = form.toOwn(vectorOf(store.position()[i]));
      if (isBlock && !isInOneFace(form, own, spacing)) continue;
      const SolidSurface::Near near = surface.at(own);
      if (near.distance > -spacing && near.distance < 0)
        noted[i] = float4Of(form.toScene(near.normal) - form.middle(), static_cast<float>(-near.distance));
    }
  });
}

namespace {

double surfaceAreaOf(const Body& body, double spacing) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) {
    const Vector3& s = box->size;
    return 2 * (s.x() * s.y() + s.y() * s.z() + s.z() * s.x());
  }
  const auto* solid = std::get_if<SolidShape>(&body.shape);
  if (!solid) return 0;
  const SolidForm form(*solid);
  if (form.kind() == SolidForm::Kind::Rope) return 0;
  if (form.isOneLayer()) return form.volume(1);
  double area = 0;
  for (const MeshNearest::Triangle& t : facetsOf(*solid, kFacetError * spacing))
    area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
  return area;
}

}  // namespace

double ShapeSurfaces::areaOf(const Body& body, double spacing) {
  const auto* solid = std::get_if<SolidShape>(&body.shape);
  if (!solid) return surfaceAreaOf(body, spacing);
  Area& known = m_areas[body.id];
  SolidShape upright = withoutPose(*solid);
  if (known.spacing != spacing || !(known.upright == upright))
    known = {std::move(upright), spacing, surfaceAreaOf(body, spacing)};
  return known.area;
}

std::optional<FixedShape> ShapeSurfaces::of(const Body& body, uint32_t index, double spacing) {
  const auto* solid = std::get_if<SolidShape>(&body.shape);
  if (!solid) return std::nullopt;
  const SolidForm form(*solid);
  if (form.isThin()) return std::nullopt;
  Known& known = m_known[body.id];
  SolidShape upright = withoutPose(*solid);
  if (!known.shape.surface || known.spacing != spacing || !(known.upright == upright)) {
    std::vector<MeshNearest::Triangle> facets = facetsOf(*solid, kFacetError * spacing);
    if (facets.empty()) return std::nullopt;
    known.shape.surface = std::make_shared<const MeshNearest>(std::move(facets));
    known.shape.closed = !form.isHollow() && (!solid->mesh || factsOf(*solid->mesh).closed());
    known.shape.stamp = stampOf(upright);
    known.spacing = spacing;
    known.upright = std::move(upright);
  }
  FixedShape shape = known.shape;
  shape.body = index;
  shape.pose = {Quaternion(form.axes()), form.middle()};
  return shape;
}

void ShapeSurfaces::note(ParticleStore& store, std::span<const uint32_t> ids, const Body& body, double spacing) {
  if (!toggleOf(body.parameters, bodyParameters(), "fixed")) return;
  const std::optional<FixedShape> shape = of(body, 0, spacing);
  if (!shape) return;
  store.declare(field::kShapePlace, api::FieldType::Float4, "m", "place in a fixed shape, and a mark of that");
  auto* places = static_cast<api::Float4*>(store.find(field::kShapePlace, api::FieldType::Float4));
  const SolidForm form(std::get<SolidShape>(body.shape));
  const float mark = markOf(shape->stamp, ids.size());
  for (const uint32_t id : ids) {
    const size_t i = store.indexOf(id);
    places[i] = float4Of(form.toOwn(vectorOf(store.position()[i])), mark);
  }
}

}  // namespace ps
