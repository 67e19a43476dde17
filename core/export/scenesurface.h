// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/geometry/particlesurface.h"
#include "core/simulation/snapshot.h"

#include <cstdint>
#include <vector>

namespace ps {

/// The surface of what is of one material and no vapour; `values` are temperatures in K.
struct MaterialSurface {
  uint32_t material = 0;  ///< index as in Snapshot::material
  ParticleSurface surface;
};

/// Of every material that there is. Cells are half a spacing. In space that repeats itself, surfaces end at its faces.
std::vector<MaterialSurface> surfacesOf(const Snapshot& snapshot);

}  // namespace ps
