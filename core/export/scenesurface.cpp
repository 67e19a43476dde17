// SPDX-License-Identifier: Apache-2.0
#include "core/export/scenesurface.h"

#include "core/base/askat.h"

#include <algorithm>

namespace ps {
namespace {
constexpr float kVapour = 0.5F;  // share from which matter counts as vapour: it has no surface
constexpr double kCellsPerSpacing = 2;
}  // namespace

std::vector<MaterialSurface> surfacesOf(const Snapshot& snapshot) {
  std::vector<MaterialSurface> all;
  const auto materials = static_cast<uint32_t>(snapshot.materialIds.size());
  for (uint32_t material = 0; material < materials; ++material) {
    std::vector<api::Float4> spheres;
    std::vector<float> temperatures;
    for (size_t i = 0; i < snapshot.position.size(); ++i) {
      askAt(i);
      if (snapshot.material[i] != material || snapshot.gasFraction[i] >= kVapour) continue;
      spheres.push_back(snapshot.position[i]);
      temperatures.push_back(snapshot.temperature[i]);
    }
    ParticleSurface surface = surfaceAround(spheres, temperatures, snapshot.spacing / kCellsPerSpacing);
    if (!surface.triangles.empty()) all.push_back({material, std::move(surface)});
  }
  return all;
}

}  // namespace ps
