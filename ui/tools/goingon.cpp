// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/goingon.h"

#include "core/scene/pose.h"
#include "core/simulation/standing.h"
#include "core/sketch/cellset.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace ps {
namespace {

constexpr double kStill = 0.25;  // spacings that a body has settled by, which is no other place
constexpr double kWidth = 3;     // spacings about a thin brush that tell how a body stands

/// The palette entry of which a body takes more: it is sketched and free, held or not and become as the brush asks, and
/// has matter of that material at that temperature, or takes any. One that is turned takes none of what is mirrored
/// along the scene.
std::optional<int> takesMore(const Document& document, const Body& body, const std::string& material,
                             const BrushSettings& brush, const StrokeSetup& setup) {
  const auto* voxels = std::get_if<VoxelShape>(&body.shape);
  if (!voxels || body.locked || !body.visible || voxels->origin != setup.grid.origin ||
      voxels->spacing != setup.grid.spacing || (setup.symmetry && !poseOf(*voxels).isNothing()) ||
      toggleOf(body.parameters, bodyParameters(), "held") != brush.held ||
      !hasBecome(body, brush.becomes, document.project(), *document.plugins(), brush.temperature))
    return std::nullopt;
  for (size_t k = 0; k < voxels->palette.size(); ++k) {
    if (voxels->palette[k].material == material && voxels->palette[k].temperature == brush.temperature &&
        voxels->palette[k].colour.empty())
      return static_cast<int>(k);
  }
  // What says the phase of all of it would say that of the other matter, too.
  const bool any = brush.joins && choiceOf(body.parameters, bodyParameters(), "phase") == "automatic";
  return any ? std::optional(static_cast<int>(voxels->palette.size())) : std::nullopt;
}

struct Candidate {
  GoingOn found;
  uint32_t index = 0;
  bool solid = false;                                        ///< some of what is near
  double nearest = std::numeric_limits<double>::infinity();  ///< m², of its matter within reach
  std::vector<Vector3> places{};                             ///< m, of all of that
};

/// Those that take more, with what of them is within reach, the nearest one first.
std::vector<Candidate> candidatesAt(const Document& document, const Snapshot& now, const Vector3& place,
                                    const Vector3& reach, const std::string& material, const BrushSettings& brush,
                                    const StrokeSetup& setup) {
  std::vector<Candidate> all(now.bodyIds->size());
  for (uint32_t b = 0; b < all.size(); ++b) {
    const Body* body = document.body((*now.bodyIds)[b]);
    const auto entry = body ? takesMore(document, *body, material, brush, setup) : std::nullopt;
    if (entry) all[b].found = {body, *entry, {}};
    all[b].index = b;
  }
  for (size_t i = 0; i < now.position.size(); ++i) {
    if (now.body[i] >= all.size() || !all[now.body[i]].found.body) continue;
    const Vector3 there = vectorOf(now.position[i]);
    if (((there - place).cwiseAbs().array() > reach.array()).any()) continue;
    Candidate& near = all[now.body[i]];
    near.solid = near.solid || api::holds(now.motion[i]);
    near.nearest = std::min(near.nearest, (there - place).squaredNorm());
    near.places.push_back(there);
  }
  std::erase_if(all, [](const Candidate& one) { return one.places.empty(); });
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.nearest < b.nearest; });
  return all;
}

/// Some of its matter lies where the document has it: what moved away goes on without what is drawn where it was.
bool isInPlace(const VoxelShape& voxels, const std::vector<Vector3>& places) {
  const CellSet cells = VoxelCanvas(voxels.runs).cells();
  const SketchGrid grid = gridOf(voxels);
  return std::any_of(places.begin(), places.end(), [&](const Vector3& p) { return cells.contains(grid.cellAt(p)); });
}

bool isStill(const Body& body, const RigidMove& way, double spacing) {
  const BodyBounds box = boundsOf(body);
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 c(corner & 1 ? box.maximum.x() : box.minimum.x(), corner & 2 ? box.maximum.y() : box.minimum.y(),
                    corner & 4 ? box.maximum.z() : box.minimum.z());
    if (!((way.of(c) - c).norm() <= kStill * spacing)) return false;
  }
  return true;
}

}  // namespace

std::optional<GoingOn> goingOnAt(const Document& document, const Snapshot& now, const Vector3& place,
                                 const Vector3& reach, const std::string& material, const BrushSettings& brush,
                                 const StrokeSetup& setup) {
  if (!now.bodyIds) return std::nullopt;
  const double spacing = setup.grid.spacing;
  for (Candidate& one : candidatesAt(document, now, place, reach, material, brush, setup)) {
    const auto& voxels = std::get<VoxelShape>(one.found.body->shape);
    const RigidMove pose = poseOf(voxels);
    const double within = std::max(reach.maxCoeff(), kWidth * spacing);
    const auto stands =
        one.solid && now.stats.frame > 0 ? standingNear(now, one.index, pose, place, within) : std::nullopt;
    if (!stands) {
      if (isInPlace(voxels, one.places)) return one.found;
      continue;
    }
    const RigidMove way = stands->after(pose.inverse());
    if (isStill(*one.found.body, way, spacing)) return one.found;
    if (setup.symmetry) continue;
    one.found.way = way;
    return one.found;
  }
  return std::nullopt;
}

}  // namespace ps
