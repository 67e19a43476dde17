// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"

#include <optional>
#include <utility>

// What a view shows that has no camera of its own.
namespace ps {

using Box = std::pair<Vector3, Vector3>;  ///< lowest and highest corner, m

/// Around the spheres of each body, by its index; nothing for one without matter.
std::vector<std::optional<Box>> boxesOfBodies(const Snapshot& snapshot);
/// Around all matter and the walls that close the scene in; around its bounds where there is neither.
Box boxOf(const Snapshot& snapshot, const Environment& environment);
/// From the usual angles, so that the whole of boxOf() is in the picture.
Camera cameraShowing(const Snapshot& snapshot, const Environment& environment, int width, int height);

}  // namespace ps
