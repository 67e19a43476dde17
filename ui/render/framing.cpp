// SPDX-License-Identifier: Apache-2.0
#include "ui/render/framing.h"

#include "core/scene/scenewall.h"
#include "ui/render/furniture.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

void join(std::optional<Box>& box, const Vector3& low, const Vector3& high) {
  box = box ? Box{box->first.cwiseMin(low), box->second.cwiseMax(high)} : Box{low, high};
}

/// Around the spheres of all particles. Nothing when there are none.
std::optional<Box> boxOfMatter(const Snapshot& snapshot) {
  std::optional<Box> box;
  for (size_t i = 0; i < snapshot.position.size(); ++i) {
    const api::Float4& p = snapshot.position[i];
    if (!std::isfinite(p.x + p.y + p.z + p.w)) continue;
    const Vector3 centre = vectorOf(p), radius = Vector3::Constant(static_cast<double>(p.w));
    join(box, centre - radius, centre + radius);
  }
  return box;
}

}  // namespace

std::vector<std::optional<Box>> boxesOfBodies(const Snapshot& snapshot) {
  std::vector<std::optional<Box>> boxes(snapshot.bodyIds ? snapshot.bodyIds->size() : 0);
  for (size_t i = 0; i < snapshot.position.size(); ++i) {
    const api::Float4& p = snapshot.position[i];
    if (snapshot.body[i] >= boxes.size() || !std::isfinite(p.x + p.y + p.z + p.w)) continue;
    const Vector3 centre = vectorOf(p), radius = Vector3::Constant(static_cast<double>(p.w));
    join(boxes[snapshot.body[i]], centre - radius, centre + radius);
  }
  return boxes;
}

Box boxOf(const Snapshot& snapshot, const Environment& environment) {
  std::optional<Box> box = boxOfMatter(snapshot);
  for (size_t i = 0; i < environment.walls.size(); ++i) {
    const WallFace round = faceOf(environment.walls[i]);
    if (round.form() == WallForm::Sphere && round.isInside()) {
      const Vector3 radius = Vector3::Constant(round.radius());
      join(box, round.centre() - radius, round.centre() + radius);
    }
    // A wall that goes on to the bounds, like a floor without sides, is as large as the world and would make everything
    // else small.
    const render::Face face = render::wallFace(environment, i);
    if (!std::all_of(face.walled.begin(), face.walled.end(), [](bool walled) { return walled; })) continue;
    for (const Vector3& corner : face.corners) join(box, corner, corner);
  }
  return box.value_or(Box{environment.boundsMinimum, environment.boundsMaximum});
}

Camera cameraShowing(const Snapshot& snapshot, const Environment& environment, int width, int height) {
  Camera camera;
  const auto [low, high] = boxOf(snapshot, environment);
  frameAll(camera, width, height, low, high);
  return camera;
}

}  // namespace ps
