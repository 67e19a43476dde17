// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/phasebands.h"

#include <array>
#include <vector>

namespace ps {

struct Material;
struct SceneShot;

/// A sample of a material as it is in a room: all that its picture depends on.
struct Swatch {
  std::array<float, 4> look{};  ///< sRGB and clearness, as Snapshot::materialLook
  api::Phase phase = api::Phase::Solid;
  bool operator==(const Swatch&) const = default;
};

/// `bands`: the material's, where they are known already.
Swatch swatchOf(const Material& material, const std::vector<PhaseBand>& bands);
Swatch swatchOf(const Material& material);
/// A lump of it, a drop or a cloud. Its particles are put where they are: for a picture as small as this no plugin has
/// to run, and what scene is open does not matter.
SceneShot shotOf(const Swatch& swatch);

}  // namespace ps
