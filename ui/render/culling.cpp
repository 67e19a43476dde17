// SPDX-License-Identifier: Apache-2.0
#include "ui/render/instances.h"
#include "ui/render/projector.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

// Why on the processor: sphere shaders write depth, so nothing hidden is rejected before it is shaded. Where a
// processor shades as well, finding what is hidden first costs a tenth of shading it.
namespace ps::render {
namespace {

struct Disc {
  float depth, x, y, least, most;  // m along the view, pixels
  uint32_t index;
};

constexpr float kCell = 2;  // pixels

/// Space in cells of one width, with an empty one all around.
class Cells {
 public:
  /// None where there would be too many to be worth a search.
  static std::optional<Cells> of(const Extent& extent, float cell) {
    constexpr double kMost = 1u << 22;
    std::array<double, 3> counts{};
    for (size_t k = 0; k < 3; ++k) counts[k] = (double{extent.maximum[k]} - double{extent.minimum[k]}) / cell + 3;
    if (!(counts[0] * counts[1] * counts[2] <= kMost)) return std::nullopt;
    Cells cells;
    cells.m_least = extent.minimum;
    cells.m_cell = cell;
    std::transform(counts.begin(), counts.end(), cells.m_counts.begin(),
                   [](double count) { return static_cast<size_t>(count); });
    return cells;
  }
  size_t at(const Instance& p) const {
    const auto along = [&](float v, size_t k) { return static_cast<size_t>((v - m_least[k]) / m_cell) + 1; };
    return (along(p.z, 2) * m_counts[1] + along(p.y, 1)) * m_counts[0] + along(p.x, 0);
  }
  size_t count() const { return m_counts[0] * m_counts[1] * m_counts[2] + 1; }
  size_t row() const { return m_counts[0]; }
  size_t layer() const { return m_counts[0] * m_counts[1]; }

 private:
  std::array<float, 3> m_least{};
  float m_cell = 1;
  std::array<size_t, 3> m_counts{};
};

/// The cells that hang together with one, which are empty then. Returns how many particles they held.
size_t takePiece(const Cells& cells, size_t from, std::vector<uint32_t>& held, std::vector<size_t>& piece) {
  piece.assign(1, from);
  size_t size = std::exchange(held[from], 0);
  for (size_t k = 0; k < piece.size(); ++k) {
    for (const size_t layer : {piece[k] - cells.layer(), piece[k], piece[k] + cells.layer()}) {
      for (const size_t row : {layer - cells.row(), layer, layer + cells.row()}) {
        for (const size_t at : {row - 1, row, row + 1}) {
          if (at >= held.size() || held[at] == 0) continue;
          size += std::exchange(held[at], 0);
          piece.push_back(at);
        }
      }
    }
  }
  return size;
}

}  // namespace

size_t exposedFirst(const Extent& extent, float radius, float cell, int full, std::vector<Instance>& list) {
  if (list.size() < 1000) return list.size();
  const std::optional<Cells> cells = Cells::of(extent, cell);
  if (!cells) return list.size();
  std::vector<uint8_t> held(cells->count()), buried(held.size());
  for (const Instance& p : list)
    if (p.radius > 0.7f * radius) {
      uint8_t& count = held[cells->at(p)];
      count = static_cast<uint8_t>(count + (count < full));
    }
  const size_t row = cells->row(), layer = cells->layer();
  const auto threeFull = [&](size_t at) { return held[at - 1] == full && held[at] == full && held[at + 1] == full; };
  for (size_t at = layer + row + 1; at + layer + row + 1 < held.size(); ++at) {
    bool all = threeFull(at);
    for (const size_t base : {at - layer - row, at - layer, at - layer + row, at - row, at + row, at + layer - row,
                              at + layer, at + layer + row})
      all = all && threeFull(base);
    buried[at] = all;
  }
  const auto exposed = [&](const Instance& p) { return buried[cells->at(p)] == 0; };
  return static_cast<size_t>(std::stable_partition(list.begin(), list.end(), exposed) - list.begin());
}

size_t piecesFirst(const Extent& extent, float cell, size_t least, std::vector<Instance>& list) {
  if (list.size() < least) return list.size();
  const std::optional<Cells> cells = Cells::of(extent, cell);
  if (!cells) return list.size();
  std::vector<uint32_t> held(cells->count());
  for (const Instance& p : list) ++held[cells->at(p)];
  std::vector<uint8_t> small(held.size());
  std::vector<size_t> piece;
  for (const Instance& p : list) {
    if (held[cells->at(p)] == 0) continue;  // of a piece that is known by now
    const size_t size = takePiece(*cells, cells->at(p), held, piece);
    for (size_t k = 0; size < least && k < piece.size(); ++k) small[piece[k]] = 1;
  }
  const auto large = [&](const Instance& p) { return small[cells->at(p)] == 0; };
  const auto rest = std::stable_partition(list.begin(), list.end(), large);
  return rest == list.begin() ? list.size() : static_cast<size_t>(rest - list.begin());
}

void sortVisible(const Projector& projector, std::span<const Instance> spheres, std::vector<Instance>& visible) {
  std::vector<Disc> discs(spheres.size());
  for (size_t i = 0; i < spheres.size(); ++i) {
    const Instance& p = spheres[i];
    const Projector::Place at = projector.at(p.x, p.y, p.z);
    const auto [least, most] = projector.radiiOf(p.radius, at);
    discs[i] = {at.depth, at.x, at.y, least, most, static_cast<uint32_t>(i)};
  }
  std::sort(discs.begin(), discs.end(),
            [](const Disc& a, const Disc& b) { return a.depth != b.depth ? a.depth < b.depth : a.index < b.index; });

  const int columns = static_cast<int>(projector.width() / kCell), rows = static_cast<int>(projector.height() / kCell);
  // Depth of the nearest sphere that fills a cell.
  std::vector<float> covered(static_cast<size_t>(columns * rows), 1e30f);
  visible.clear();
  visible.reserve(spheres.size());
  for (const Disc& disc : discs) {
    const Instance& sphere = spheres[disc.index];
    const float radius = sphere.radius, cx = disc.x / kCell - 0.5f, cy = disc.y / kCell - 0.5f;
    const float reach = disc.most / kCell, inner = std::max(disc.least / kCell - 0.8f, 0.f);
    const auto bound = [](float v, int most) { return static_cast<int>(std::clamp(v, 0.f, static_cast<float>(most))); };
    // At the eye: drawn, hides nothing.
    bool seen = disc.depth < std::max(2 * radius, projector.near()) || reach < 1;
    if (disc.depth >= std::max(2 * radius, projector.near()))
      for (int y = bound(std::ceil(cy - reach), rows); y < bound(std::floor(cy + reach) + 1, rows); ++y)
        for (int x = bound(std::ceil(cx - reach), columns); x < bound(std::floor(cx + reach) + 1, columns); ++x) {
          float& cell = covered[static_cast<size_t>(y * columns + x)];
          const float dx = static_cast<float>(x) - cx, dy = static_cast<float>(y) - cy, square = dx * dx + dy * dy;
          if (square > reach * reach) continue;
          seen = seen || cell > disc.depth - radius;
          if (square < inner * inner) cell = std::min(cell, disc.depth);
        }
    if (seen) visible.push_back(sphere);
  }
}

}  // namespace ps::render
