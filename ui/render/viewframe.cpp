// SPDX-License-Identifier: Apache-2.0
#include "ui/render/viewframe.h"

#include "ui/render/colourmap.h"
#include "ui/render/passes.h"
#include "ui/render/prepared.h"
#include "ui/render/projector.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace ps::render {
namespace {

float linear(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }

/// Pixels that a box may touch; the whole picture when a corner is behind the eye.
std::array<int, 4> pixelsOf(const Extent& extent, const Eye& eye, int width, int height) {
  double x0 = width, y0 = height, x1 = 0, y1 = 0;
  if (extent.empty()) return {0, 0, 0, 0};
  for (const Vector3& corner : extent.corners()) {
    const std::optional<Vector3> p = project(eye, width, height, corner);
    if (!p) return {0, 0, width, height};
    x0 = std::min(x0, p->x()), x1 = std::max(x1, p->x());
    y0 = std::min(y0, p->y()), y1 = std::max(y1, p->y());
  }
  const int left = static_cast<int>(std::clamp(x0 - 3, 0.0, 1.0 * width)),
            right = static_cast<int>(std::clamp(x1 + 4, 0.0, 1.0 * width));
  const int top = static_cast<int>(std::clamp(y0 - 3, 0.0, 1.0 * height)),
            bottom = static_cast<int>(std::clamp(y1 + 4, 0.0, 1.0 * height));
  return {left, height - bottom, right - left, bottom - top};
}

/// The smallest box that holds both.
std::array<int, 4> joined(const std::array<int, 4>& a, const std::array<int, 4>& b) {
  if (a[2] < 1 || a[3] < 1) return b;
  if (b[2] < 1 || b[3] < 1) return a;
  const int x = std::min(a[0], b[0]), y = std::min(a[1], b[1]);
  return {x, y, std::max(a[0] + a[2], b[0] + b[2]) - x, std::max(a[1] + a[3], b[1] + b[3]) - y};
}

void markSpheres(TileSet& tiles, const Projector& projector, std::span<const Instance> spheres, float reach,
                 float margin = 3) {
  for (const Instance& p : spheres) {
    const Projector::Place at = projector.at(p.x, p.y, p.z);
    if (at.depth > -p.radius) tiles.mark(at.x, at.y, reach * projector.radiiOf(p.radius, at).most + margin);
  }
}

void markEdges(TileSet& tiles, const Projector& projector, const std::vector<MeshVertex>& mesh) {
  for (size_t i = 0; i + 2 < mesh.size(); i += 3) {
    if (mesh[i].material[3] == static_cast<float>(Kind::PlateTop)) continue;
    std::array<Projector::Place, 3> at;
    for (size_t k = 0; k < 3; ++k) {
      const auto& p = mesh[i + k].position;
      at[k] = projector.at(p[0], p[1], p[2]);
      if (at[k].depth < projector.near()) return tiles.markAll();
    }
    // Triangles come in pairs along an edge: the longer of two sides runs along it.
    const auto length = [&](size_t k) { return std::hypot(at[k + 1].x - at[k].x, at[k + 1].y - at[k].y); };
    const size_t k = length(0) > length(1) ? 0 : 1;
    tiles.markLine(at[k].x, at[k].y, at[k + 1].x, at[k + 1].y, 4);
  }
}

}  // namespace

int innerScale(const PictureSize& size) { return size.still ? 2 : 1; }

void ViewFrame::fill(const Prepared& prepared, const Eye& eye, const RenderTarget& target, const Quality& quality) {
  const int scale = innerScale(target.size);
  place = {target.framebuffer, target.x, target.y};
  texture = target.texture;
  width = target.size.width * scale;
  height = target.size.height * scale;
  still = target.size.still;
  coarser = target.coarser;
  culled = quality.cull;
  const BodyOutline line = prepared.look.outline.value_or(BodyOutline());
  lineWidth = line.lineWidth * static_cast<float>(scale);
  haloWidth = line.haloWidth * static_cast<float>(scale);
  ghostWidth = (prepared.look.ghost ? prepared.look.ghost->lineWidth : 0) * static_cast<float>(scale);
  lidInFront = placeOf(eye).y() > static_cast<double>(prepared.furniture.lidHeight);
  vapourBox = pixelsOf(prepared.instances.vapourExtent, eye, width, height);
  liquidBox = pixelsOf(prepared.instances.liquidExtent, eye, width, height);
  distanceBox = liquidBox;
  for (const Extent* extent :
       {&prepared.instances.sphereExtent, &prepared.furniture.opaqueExtent, &prepared.propsExtent})
    distanceBox = joined(distanceBox, pixelsOf(*extent, eye, width, height));
  amongSpheres = prepared.instances.sphereExtent.holds(placeOf(eye));
  amongLiquids = prepared.instances.liquidExtent.holds(placeOf(eye));
  chooseThickness(prepared, eye, quality.fluidScale);
  fillUniforms(prepared, eye);
  findTiles(prepared, eye);
  hide(target, eye);
  listTiles(quality.compute);
}

void ViewFrame::fillUniforms(const Prepared& prepared, const Eye& eye) {
  FrameUniforms& u = uniforms;
  const Furniture& furniture = prepared.furniture;
  const ContactMap& contact = prepared.contact;
  const Matrix4& projection = eye.projection;
  const Vector3 from = placeOf(eye);
  const auto f = [](double v) { return static_cast<float>(v); };
  u.view = uniformOf(eye.view);
  u.projection = uniformOf(projection);
  u.inverseView = uniformOf(eye.view.inverse());
  u.shadow = prepared.shadow;
  u.eye = {f(from.x()), f(from.y()), f(from.z()), 0};
  u.size = {f(width), f(height), 1 / f(width), 1 / f(height)};
  u.lens = {f(1 / projection(0, 0)), f(1 / projection(1, 1)), f(projection(2, 2)), f(projection(2, 3))};
  u.light = {f(kKeyLight.x()), f(kKeyLight.y()), f(kKeyLight.z()), prepared.look.dark ? 1.f : 0.f};
  u.plate = {furniture.centre[0], furniture.centre[1], furniture.half[0], furniture.half[1]};
  u.ground = {furniture.floor, furniture.ground, furniture.floorHeat, furniture.hasFloor ? 1.f : 0.f};
  u.contact = {contact.corner[0], contact.corner[1], 1 / contact.size[0], 1 / contact.size[1]};
  u.matter = {prepared.instances.radius, prepared.time, prepared.data ? 1.f : 0.f, furniture.size};
  const Colour glow = sceneColour(prepared.look.dark, "glow");
  u.glowTint = {linear(glow[0]) * 1.25f, linear(glow[1]) * 1.25f, linear(glow[2]) * 1.25f, 0};
}

/// How thick liquid is varies no faster than its particles are wide, and adding them up costs by the pixel: from near
/// or in a large picture the same number of pixels to a particle is enough.
void ViewFrame::chooseThickness(const Prepared& prepared, const Eye& eye, int finest) {
  constexpr double kPixels = 2.25;  // in half a particle's width
  constexpr int kCoarsest = 16;
  thicknessScale = finest;
  const Extent& extent = prepared.instances.liquidExtent;
  if (extent.empty()) return;
  const auto corners = extent.corners();
  const Vector3 middle = (corners.front() + corners.back()) / 2;
  const double distance = std::max((middle - placeOf(eye)).norm(), 0.25 * (corners.back() - corners.front()).norm());
  const double radius =
      static_cast<double>(kThicknessGrowth * prepared.instances.radius) * eye.projection(1, 1) * height / 2 / distance;
  thicknessScale = std::clamp(static_cast<int>(radius / kPixels), finest, kCoarsest);
}

/// What shows, which parts of the picture have liquid, and which have edges to smooth or crevices to darken.
void ViewFrame::findTiles(const Prepared& prepared, const Eye& eye) {
  for (TileSet* tiles : {&liquid, &detail, &outline, &ghost, &all}) tiles->reset(width, height);
  all.markAll();
  if (culled) {
    const Instances& instances = prepared.instances;
    const Projector projector(eye, width, height);
    const auto part = [&](Range range) { return std::span(instances.particles).subspan(range.first, range.count); };
    sortVisible(projector, part(instances.sphereRange(amongSpheres)), visible);
    markSpheres(liquid, projector, part(instances.liquidRange(amongLiquids)), 1.4f);
    markSpheres(detail, projector, visible, 2.5f);
    markSpheres(outline, projector, part(instances.outlineRange()), 1.2f, 3 + lineWidth + haloWidth);
    markSpheres(ghost, projector, part(instances.ghostRange()), 1, 3);
    for (const auto* mesh :
         {&prepared.furniture.opaque, &prepared.furniture.clear, &prepared.props.opaque, &prepared.props.clear})
      markEdges(detail, projector, *mesh);
  } else {
    for (TileSet* tiles : {&liquid, &detail, &outline, &ghost}) tiles->markAll();
  }
}

void ViewFrame::hide(const RenderTarget& target, const Eye& eye) {
  hidden = m_hidden.find(target.hidden, eye, width, height);
  if (!hidden) return;
  for (TileSet* tiles : {&liquid, &detail, &outline, &ghost, &all}) tiles->remove(hidden->tiles);
}

/// Programs that compute work on all of a picture, but for the outline, which is drawn.
void ViewFrame::listTiles(bool computed) {
  outline.triangles(outlineTiles);
  if (computed) return;
  all.triangles(allTiles);
  ghost.triangles(ghostTiles);
  liquid.triangles(liquidTiles);
  detail.triangles(detailTiles);
}

}  // namespace ps::render
