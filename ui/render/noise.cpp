// SPDX-License-Identifier: Apache-2.0
#include "ui/render/noise.h"

#include <algorithm>

namespace ps::render {
namespace {

// Value noise that repeats after 256 texels; `cells` to a side.
float noiseAt(int x, int y, int cells, uint32_t seed) {
  const auto lattice = [&](int i, int j) {
    uint32_t h = static_cast<uint32_t>(i % cells) * 374761393u + static_cast<uint32_t>(j % cells) * 668265263u +
                 seed * 2246822519u;
    h = (h ^ h >> 13) * 1274126177u;
    return static_cast<float>((h ^ h >> 16) & 0xFFFF) / 65535;
  };
  const int step = 256 / cells;
  const auto curve = [&](int v) {
    const float t = static_cast<float>(v % step) / static_cast<float>(step);
    return t * t * (3 - 2 * t);
  };
  const int i = x / step, j = y / step;
  const float u = curve(x), v = curve(y);
  const float low = lattice(i, j) + (lattice(i + 1, j) - lattice(i, j)) * u;
  const float high = lattice(i, j + 1) + (lattice(i + 1, j + 1) - lattice(i, j + 1)) * u;
  return low + (high - low) * v;
}

}  // namespace

std::vector<uint8_t> noiseTexels() {
  std::vector<uint8_t> texels(256 * 256 * 4, 255);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      uint8_t* texel = &texels[static_cast<size_t>((y * 256 + x) * 4)];
      const float grain = 0.5f * noiseAt(x, y, 256, 1) + 0.3f * noiseAt(x, y, 128, 2) + 0.2f * noiseAt(x, y, 32, 3);
      float cloud = 0, amplitude = 0.5f;
      for (int cells = 4; cells <= 64; cells *= 2, amplitude *= 0.5f)
        cloud += amplitude * noiseAt(x, y, cells, 10u + static_cast<uint32_t>(cells));
      texel[0] = static_cast<uint8_t>(255 * grain);
      texel[1] = static_cast<uint8_t>(255 * std::min(cloud / 0.97f, 1.f));
    }
  return texels;
}

}  // namespace ps::render
