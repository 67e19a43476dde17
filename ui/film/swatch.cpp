// SPDX-License-Identifier: Apache-2.0
#include "ui/film/swatch.h"

#include "core/matter/material.h"
#include "ui/film/sceneshot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

/// A ball, pressed flat and cut off below. All in m: a picture has no scale.
struct Form {
  double spacing;        ///< of particles
  double width, height;  ///< from the middle
  double floor;          ///< where it is cut off
};

/// As fine as it takes for grains that can be told apart in a small picture, and for a drop without bumps. A cloud is
/// wider than the places of its parcels.
Form formOf(api::Phase phase) {
  if (phase == api::Phase::Gas) return {0.22, 0.55, 0.45, -0.45};
  if (phase == api::Phase::Liquid) return {0.08, 1, 0.6, -0.1};
  return {0.12, 1, 1, -1};
}

void add(Snapshot& snapshot, const Vector3& place, double radius, api::Phase phase) {
  const bool gas = phase == api::Phase::Gas, liquid = phase == api::Phase::Liquid;
  snapshot.id.push_back(static_cast<uint32_t>(snapshot.position.size()));
  snapshot.position.push_back(float4Of(place, static_cast<float>(radius)));
  snapshot.temperature.push_back(static_cast<float>(kRoom));
  snapshot.speed.push_back(0);
  snapshot.densityError.push_back(0);
  snapshot.gasFraction.push_back(gas ? 1.f : 0.f);
  snapshot.phase.push_back(phase);
  snapshot.motion.push_back(gas ? api::Motion::Gas : liquid ? api::Motion::Liquid : api::Motion::Solid);
  snapshot.body.push_back(0);
  snapshot.material.push_back(0);
}

/// Layers in which particles lie like the seeds of a sunflower: the rim is round, and no rows show.
SnapshotPtr sampleOf(const Swatch& swatch) {
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  auto sample = std::make_shared<Snapshot>();
  sample->materialLook = {swatch.look};
  const auto [spacing, width, height, floor] = formOf(swatch.phase);
  const double radius = 0.62 * spacing;  // of a sphere as large as a cell
  uint32_t turns = 0;
  for (double y = floor + spacing / 2; y < height; y += spacing) {
    const double reach = width * std::sqrt(1 - y * y / (height * height));
    const auto count = std::max(1L, std::lround(std::numbers::pi * reach * reach / (spacing * spacing)));
    for (long k = 0; k < count; ++k) {
      const double from = reach * std::sqrt((static_cast<double>(k) + 0.5) / static_cast<double>(count));
      const double angle = turn * ++turns;
      add(*sample, {from * std::cos(angle), y, from * std::sin(angle)}, radius, swatch.phase);
    }
  }
  return sample;
}

}  // namespace

Swatch swatchOf(const Material& material, const std::vector<PhaseBand>& bands) {
  Swatch swatch;
  constexpr const char* kKeys[] = {"color_red", "color_green", "color_blue", "clearness"};
  for (size_t k = 0; k < swatch.look.size(); ++k)
    swatch.look[k] = static_cast<float>(std::clamp(valueOf(material, kKeys[k], kRoom), 0.0, 1.0));
  for (const PhaseBand& band : bands) {
    if (kRoom >= band.from && kRoom < band.to) swatch.phase = band.phase;
  }
  return swatch;
}

Swatch swatchOf(const Material& material) { return swatchOf(material, bandsOf(material)); }

SceneShot shotOf(const Swatch& swatch) {
  SceneShot shot{sampleOf(swatch), {}, {}, {}};
  shot.scene.environment.boundsMinimum = {-1, -1, -1};
  shot.scene.environment.boundsMaximum = {1, 1, 1};
  const Form form = formOf(swatch.phase);
  shot.camera.target = {0, (form.floor + form.height) / 2, 0};
  shot.camera.distance = 3.7;
  // A shade darker than its colour: most gases are all but white, and would not show on a light ground.
  constexpr float kShade = 0.75f;
  shot.look.vapour = {kShade * swatch.look[0], kShade * swatch.look[1], kShade * swatch.look[2]};
  return shot;
}

}  // namespace ps
