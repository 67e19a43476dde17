// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

namespace ps::render {

/// 256 x 256 texels of RGBA8 that repeat. Red: fine grain for brushed metal. Green: clouds.
std::vector<uint8_t> noiseTexels();

}  // namespace ps::render
