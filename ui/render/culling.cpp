// SPDX-License-Identifier: Apache-2.0
#include "ui/render/instances.h"

#include <algorithm>
#include <cmath>

// Why on the processor: sphere shaders write depth, so nothing hidden is rejected before it is shaded. Where a
// processor shades as well, finding what is hidden first costs a tenth of shading it.
namespace ps::render {
namespace {

struct Disc {
  float depth, x, y, radius;  // m along the view, pixels
  uint32_t index;
  bool seen;
};

constexpr float kCell = 2;  // pixels

}  // namespace

void dropBuried(const Extent& extent, float radius, std::vector<Instance>& list) {
  constexpr size_t kMost = 1u << 24;
  std::array<size_t, 3> cells{};
  const float cell = 2 * radius;
  double total = 1;
  for (size_t k = 0; k < 3; ++k) {
    const float count = (extent.maximum[k] - extent.minimum[k]) / cell + 3;
    total *= static_cast<double>(count);
    cells[k] = static_cast<size_t>(std::min(count, 1e6f));
  }
  if (list.size() < 1000 || total > static_cast<double>(kMost)) return;
  const auto cellOf = [&](const Instance& p) {
    const auto along = [&](float v, size_t k) { return static_cast<size_t>((v - extent.minimum[k]) / cell) + 1; };
    return (along(p.z, 2) * cells[1] + along(p.y, 1)) * cells[0] + along(p.x, 0);
  };
  std::vector<char> full(cells[0] * cells[1] * cells[2] + 1), buried(full.size());
  for (const Instance& p : list)
    if (p.radius > 0.7f * radius) full[cellOf(p)] = 1;
  const size_t row = cells[0], layer = cells[0] * cells[1];
  for (size_t at = layer + row + 1; at + layer + row + 1 < full.size(); ++at) {
    if (!full[at] || !full[at - 1] || !full[at + 1]) continue;
    bool all = true;
    for (const size_t base : {at - layer - row, at - layer, at - layer + row, at - row, at + row, at + layer - row,
                              at + layer, at + layer + row})
      all = all && full[base - 1] && full[base] && full[base + 1];
    buried[at] = all;
  }
  std::erase_if(list, [&](const Instance& p) { return buried[cellOf(p)] != 0; });
}

size_t sortVisible(const CullView& view, std::vector<Instance>& spheres) {
  const auto& m = view.viewProjection;
  // The length of the second row is that of the projection, whatever the view's rotation: pixels per metre at depth 1.
  const float lens = std::sqrt(m[1] * m[1] + m[5] * m[5] + m[9] * m[9]) * static_cast<float>(view.height) / 2;
  std::vector<Disc> discs(spheres.size());
  for (size_t i = 0; i < spheres.size(); ++i) {
    const Instance& p = spheres[i];
    const auto row = [&](size_t r) { return m[r] * p.x + m[4 + r] * p.y + m[8 + r] * p.z + m[12 + r]; };
    const float w = row(3), safe = std::max(w, 1e-6f);
    discs[i] = {w,
                (row(0) / safe * 0.5f + 0.5f) * static_cast<float>(view.width),
                (row(1) / safe * 0.5f + 0.5f) * static_cast<float>(view.height),
                p.radius * lens / safe,
                static_cast<uint32_t>(i),
                true};
  }
  std::sort(discs.begin(), discs.end(),
            [](const Disc& a, const Disc& b) { return a.depth != b.depth ? a.depth < b.depth : a.index < b.index; });

  const int columns = view.width / static_cast<int>(kCell), rows = view.height / static_cast<int>(kCell);
  std::vector<float> covered(static_cast<size_t>(columns * rows),
                             1e30f);  // depth of the nearest sphere that fills a cell
  size_t seen = 0;
  for (Disc& disc : discs) {
    const float radius = spheres[disc.index].radius, cx = disc.x / kCell - 0.5f, cy = disc.y / kCell - 0.5f;
    const float reach = disc.radius / kCell, inner = std::max(reach - 0.8f, 0.f);
    const auto bound = [](float v, int most) { return static_cast<int>(std::clamp(v, 0.f, static_cast<float>(most))); };
    if (disc.depth < 2 * radius) continue;  // at the eye: drawn, hides nothing
    bool any = false;
    for (int y = bound(std::ceil(cy - reach), rows); y < bound(std::floor(cy + reach) + 1, rows); ++y)
      for (int x = bound(std::ceil(cx - reach), columns); x < bound(std::floor(cx + reach) + 1, columns); ++x) {
        float& cell = covered[static_cast<size_t>(y * columns + x)];
        const float dx = static_cast<float>(x) - cx, dy = static_cast<float>(y) - cy, square = dx * dx + dy * dy;
        if (square > reach * reach) continue;
        any = any || cell > disc.depth - radius;
        if (square < inner * inner) cell = std::min(cell, disc.depth);
      }
    disc.seen = any || reach < 1;
  }
  std::vector<Instance> sorted;
  sorted.reserve(spheres.size());
  for (const bool wanted : {true, false}) {
    for (const Disc& disc : discs)
      if (disc.seen == wanted) sorted.push_back(spheres[disc.index]);
    if (wanted) seen = sorted.size();
  }
  spheres.swap(sorted);
  return seen;
}

}  // namespace ps::render
