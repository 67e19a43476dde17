// SPDX-License-Identifier: Apache-2.0
#include "ui/render/instances.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ps::render {
namespace {

void blur(std::vector<float>& grid, int radius) {
  constexpr int n = ContactMap::kCells;
  std::array<float, n> line{};
  for (int pass = 0; pass < 4; ++pass) {
    const int along = pass % 2 ? n : 1, across = pass % 2 ? 1 : n;
    for (int row = 0; row < n; ++row) {
      for (int i = 0; i < n; ++i) {
        float sum = 0;
        for (int k = std::max(0, i - radius); k <= std::min(n - 1, i + radius); ++k)
          sum += grid[static_cast<size_t>(row * across + k * along)];
        line[static_cast<size_t>(i)] = sum / static_cast<float>(2 * radius + 1);
      }
      for (int i = 0; i < n; ++i) grid[static_cast<size_t>(row * across + i * along)] = line[static_cast<size_t>(i)];
    }
  }
}

}  // namespace

void fillContactMap(const Instances& instances, ContactMap& map) {
  constexpr int n = ContactMap::kCells;
  constexpr size_t kCount = static_cast<size_t>(n * n);
  for (auto& sum : map.sums) sum.assign(kCount, 0);
  auto& [close, wide, weights, red, green, blue] = map.sums;
  const std::array colour{&red, &green, &blue};
  const float cell = map.size[0] * map.size[1] / static_cast<float>(n * n);
  const float reach = instances.radius * 3, tall = 0.18f * std::max(map.size[0], map.size[1]);
  const Range liquids = instances.liquidRange(true);
  for (size_t i = instances.buriedSpheres; i < liquids.first + liquids.count; ++i) {
    const Instance& p = instances.particles[i];
    const float x = (p.x - map.corner[0]) / map.size[0] * n, z = (p.z - map.corner[1]) / map.size[1] * n;
    const float height = p.y - p.radius - map.floor;
    // Asked of the floats: what has flown away is where no int reaches.
    if (!(x >= 0 && z >= 0 && x < n && z < n) || height < -2 * p.radius) continue;
    const size_t at = static_cast<size_t>(z) * n + static_cast<size_t>(x);
    const float share = 3.14f * p.radius * p.radius / cell * (i >= liquids.first && !isDense(p) ? 0.3f : 1);
    const float w = share * std::exp(-std::max(0.f, height) / reach);
    close[at] += w;
    wide[at] += share * std::exp(-std::max(0.f, height) / tall) * 0.35f;
    const float weight = w + 0.05f * share;
    red[at] += p.red * weight, green[at] += p.green * weight, blue[at] += p.blue * weight;
  }
  for (size_t i = 0; i < kCount; ++i) weights[i] = close[i] + 0.05f / 0.35f * wide[i];
  blur(close, 1);
  blur(wide, 4);
  blur(weights, 4);
  for (auto* channel : colour) blur(*channel, 4);
  map.texels.assign(kCount * 4, 0);
  for (size_t i = 0; i < kCount; ++i) {
    const float cover = 1 - std::exp(-0.8f * close[i] - 0.75f * wide[i]);
    for (size_t k = 0; k < 3; ++k)
      map.texels[i * 4 + k] =
          static_cast<uint8_t>(255 * std::clamp((*colour[k])[i] / std::max(weights[i], 1e-5f), 0.f, 1.f));
    map.texels[i * 4 + 3] = static_cast<uint8_t>(255 * std::clamp(cover, 0.f, 1.f));
  }
}

}  // namespace ps::render
