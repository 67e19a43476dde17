// SPDX-License-Identifier: Apache-2.0
// Blocks of cells by themselves: each adds up what the spheres around it say at its nodes, and finds the points of the
// surface in its cells. Nodes on the faces are worked out by both neighbours, so that no block waits for another. Then
// the quads are tied, which reach into neighbours by one cell.
#include "core/geometry/particlesurface.h"

#include "core/base/askat.h"
#include "core/base/parallel.h"
#include "core/particles/cellgrid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace ps {
namespace {

using Point = std::array<float, 3>;
using Place = std::array<int, 3>;

constexpr int kCells = 8, kNodes = kCells + 1;  // along an edge of a block
constexpr int kRow = kNodes, kLayer = kNodes * kNodes;
constexpr size_t kNodesOfBlock = static_cast<size_t>(kNodes) * kNodes * kNodes;
constexpr size_t kCellsOfBlock = static_cast<size_t>(kCells) * kCells * kCells;
constexpr int kFarthest = 1 << 19;  // blocks from the origin: 20 bits of a key each
// With weights (1 - (d/R)^2)^3 the mean of the centres of a half-space lies 0.24609 R below a place on its face.
constexpr double kReachPerRadius = 1 / 0.24609;
// On a cubic lattice of matter no place is farther than 1.396 radii from a centre; liquid is looser.
constexpr float kGapPerRadius = 1.9F;
constexpr uint16_t kNone = 0xFFFF;
constexpr size_t kSlice = 32;  // blocks between two questions whether to go on: some hundredths of a second

uint64_t keyOf(const Place& block) {
  uint64_t key = 0;
  for (size_t a = 0; a < 3; ++a) key = key << 20 | static_cast<uint64_t>(block[2 - a] + kFarthest);
  return key;
}

Place placeOf(uint64_t key) {
  Place block{};
  for (size_t a = 0; a < 3; ++a) block[a] = static_cast<int>(key >> (20 * a) & 0xFFFFF) - kFarthest;
  return block;
}

int cellIndex(int x, int y, int z) { return (z * kCells + y) * kCells + x; }

/// What spheres say at the nodes of a block.
struct Nodes {
  std::array<float, kNodesOfBlock> weight{}, x{}, y{}, z{}, radius{}, value{}, nearest{};
};

/// An edge of the lattice that the surface crosses: from the first node of a cell along an axis.
struct Crossing {
  std::array<uint8_t, 3> cell{};
  uint8_t axis = 0;
  bool outwards = true;  ///< along the axis
};

struct Block {
  std::vector<Point> points;
  std::vector<float> values;
  std::vector<Crossing> crossings;
  std::vector<uint16_t> pointOfCell;  ///< empty where the block has none
  uint32_t first = 0;                 ///< of its points, among all
};

class Maker {
 public:
  Maker(std::span<const api::Float4> spheres, std::span<const float> values, double cell);
  ParticleSurface make();

 private:
  void addBlocks(const api::Float4& sphere, std::vector<uint64_t>& keys) const;
  void findBlocks();
  void addSphere(const api::Float4& sphere, float value, const Place& block, Nodes& nodes) const;
  void fill(const Place& block, Nodes& nodes) const;
  void findPoints(const Place& block, const Nodes& nodes, Block& out) const;
  void tie(size_t index, std::vector<std::array<uint32_t, 3>>& triangles) const;
  const Block* blockAt(const Place& place) const;

  std::vector<api::Float4> m_spheres;
  std::vector<float> m_values;
  double m_cell;
  float m_reach = 0;
  CellGrid m_grid;
  std::vector<uint64_t> m_keys;  ///< ascending, of the blocks
  std::vector<Block> m_blocks;
  ParticleSurface m_surface;
};

Maker::Maker(std::span<const api::Float4> spheres, std::span<const float> values, double cell) : m_cell(cell) {
  double radii = 0;
  const double farthest = cell * kCells * (kFarthest - 2);
  for (size_t i = 0; i < spheres.size(); ++i) {
    askAt(i);
    const api::Float4& s = spheres[i];
    const double largest = std::max({std::abs(double{s.x}), std::abs(double{s.y}), std::abs(double{s.z})});
    if (!(largest < farthest) || !std::isfinite(s.x + s.y + s.z) || !(s.w > 0) || !std::isfinite(s.w)) continue;
    m_spheres.push_back(s);
    m_values.push_back(values[i]);
    radii += double{s.w};
  }
  if (!m_spheres.empty()) m_reach = static_cast<float>(kReachPerRadius * radii / static_cast<double>(m_spheres.size()));
}

/// The blocks in whose cells there may be a node inside of this sphere.
void Maker::addBlocks(const api::Float4& s, std::vector<uint64_t>& keys) const {
  const double edge = m_cell * kCells;
  const double centre[3] = {double{s.x}, double{s.y}, double{s.z}}, far = double{kGapPerRadius * s.w} + 2 * m_cell;
  Place low{}, high{};
  for (size_t a = 0; a < 3; ++a) {
    low[a] = static_cast<int>(std::floor((centre[a] - far) / edge));
    high[a] = static_cast<int>(std::floor((centre[a] + far) / edge));
  }
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      for (int x = low[0]; x <= high[0]; ++x) {
        const uint64_t key = keyOf({x, y, z});
        if (keys.empty() || keys.back() != key) keys.push_back(key);
      }
    }
  }
}

/// Slice by slice, each sorted by itself and joined with those before: sorting all at once would answer nobody.
void Maker::findBlocks() {
  std::vector<uint64_t> some, both;
  for (size_t first = 0; first < m_spheres.size(); first += kProgressSlice) {
    const size_t last = std::min(m_spheres.size(), first + kProgressSlice);
    some.clear();
    for (size_t i = first; i < last; ++i) addBlocks(m_spheres[i], some);
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
    both.clear();
    std::set_union(m_keys.begin(), m_keys.end(), some.begin(), some.end(), std::back_inserter(both));
    m_keys.swap(both);
    advance(0);
  }
  m_blocks.resize(m_keys.size());
}

void Maker::addSphere(const api::Float4& sphere, float value, const Place& block, Nodes& nodes) const {
  const double centre[3] = {double{sphere.x}, double{sphere.y}, double{sphere.z}};
  float from[3];  // the block's first node, seen from the centre
  int low[3], high[3];
  const auto cell = static_cast<float>(m_cell);
  for (size_t a = 0; a < 3; ++a) {
    from[a] = static_cast<float>(block[a] * kCells * m_cell - centre[a]);
    low[a] = std::max(0, static_cast<int>(std::ceil((-m_reach - from[a]) / cell)));
    high[a] = std::min(kCells, static_cast<int>(std::floor((m_reach - from[a]) / cell)));
  }
  const float square = m_reach * m_reach;
  for (int k = low[2]; k <= high[2]; ++k) {
    const float dz = from[2] + static_cast<float>(k) * cell;
    for (int j = low[1]; j <= high[1]; ++j) {
      const float dy = from[1] + static_cast<float>(j) * cell, across = dz * dz + dy * dy;
      for (int i = low[0]; i <= high[0]; ++i) {
        const float dx = from[0] + static_cast<float>(i) * cell, distance = across + dx * dx;
        if (distance >= square) continue;
        const float part = 1 - distance / square, weight = part * part * part;
        const auto n = static_cast<size_t>(k * kLayer + j * kRow + i);
        nodes.weight[n] += weight;
        nodes.x[n] += weight * dx;
        nodes.y[n] += weight * dy;
        nodes.z[n] += weight * dz;
        nodes.radius[n] += weight * sphere.w;
        nodes.value[n] += weight * value;
        nodes.nearest[n] = std::min(nodes.nearest[n], distance);
      }
    }
  }
}

/// Afterwards `x` is the level, negative inside, and `value` a mean.
void Maker::fill(const Place& block, Nodes& nodes) const {
  nodes = {};
  nodes.nearest.fill(std::numeric_limits<float>::infinity());
  int low[3], high[3];
  for (size_t a = 0; a < 3; ++a) {
    low[a] = m_grid.along(block[a] * kCells * m_cell - double{m_reach}, a);
    high[a] = m_grid.along((block[a] + 1) * kCells * m_cell + double{m_reach}, a);
  }
  const std::span<const uint32_t> starts = m_grid.starts(), order = m_grid.order();
  for (int z = low[2]; z <= high[2]; ++z) {
    for (int y = low[1]; y <= high[1]; ++y) {
      const uint32_t end = starts[m_grid.cell(high[0], y, z) + 1];
      for (uint32_t slot = starts[m_grid.cell(low[0], y, z)]; slot < end; ++slot)
        addSphere(m_spheres[order[slot]], m_values[order[slot]], block, nodes);
    }
  }
  for (size_t n = 0; n < kNodesOfBlock; ++n) {
    const float weight = nodes.weight[n];
    if (weight <= 0) {
      nodes.x[n] = m_reach;
      continue;
    }
    const float x = nodes.x[n], y = nodes.y[n], z = nodes.z[n], radius = nodes.radius[n] / weight;
    const float level = std::sqrt(x * x + y * y + z * z) / weight - radius;
    nodes.x[n] = std::max(level, std::sqrt(nodes.nearest[n]) - kGapPerRadius * radius);
    nodes.value[n] /= weight;
  }
}

void Maker::findPoints(const Place& block, const Nodes& nodes, Block& out) const {
  const auto cell = static_cast<float>(m_cell);
  static constexpr int kCorner[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                        {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  static constexpr int kAxisBit[3] = {1, 2, 4};
  for (int c = 0; c < static_cast<int>(kCellsOfBlock); ++c) {
    const int at[3] = {c % kCells, c / kCells % kCells, c / (kCells * kCells)};
    float level[8], value[8];
    int inside = 0;
    for (int k = 0; k < 8; ++k) {
      const auto n = static_cast<size_t>((at[2] + kCorner[k][2]) * kLayer + (at[1] + kCorner[k][1]) * kRow + at[0] +
                                         kCorner[k][0]);
      level[k] = nodes.x[n], value[k] = nodes.value[n];
      if (level[k] < 0) ++inside;
    }
    if (inside == 0 || inside == 8) continue;
    Point sum{};
    float values = 0, weights = 0;
    int count = 0;
    for (int k = 0; k < 8; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        const int other = k | kAxisBit[axis];
        if (other == k || (level[k] < 0) == (level[other] < 0)) continue;
        const float share = level[k] / (level[k] - level[other]);
        for (int a = 0; a < 3; ++a)
          sum[static_cast<size_t>(a)] += static_cast<float>(kCorner[k][a]) + (a == axis ? share : 0);
        const int within = level[k] < 0 ? k : other;  // where nothing is near, there is no value
        values += value[within], weights += 1;
        ++count;
        if (k == 0) {
          const auto small = [&](int a) { return static_cast<uint8_t>(at[a]); };
          out.crossings.push_back({{small(0), small(1), small(2)}, static_cast<uint8_t>(axis), level[0] < 0});
        }
      }
    }
    if (out.pointOfCell.empty()) out.pointOfCell.assign(kCellsOfBlock, kNone);
    out.pointOfCell[static_cast<size_t>(c)] = static_cast<uint16_t>(out.points.size());
    Point point;
    for (size_t a = 0; a < 3; ++a)
      point[a] = static_cast<float>((block[a] * kCells + at[a]) * m_cell) + sum[a] / static_cast<float>(count) * cell;
    out.points.push_back(point);
    out.values.push_back(values / weights);
  }
}

const Block* Maker::blockAt(const Place& place) const {
  const auto found = std::lower_bound(m_keys.begin(), m_keys.end(), keyOf(place));
  return found == m_keys.end() || *found != keyOf(place) ? nullptr
                                                         : &m_blocks[static_cast<size_t>(found - m_keys.begin())];
}

/// The quad around each crossed edge, by its shorter diagonal.
void Maker::tie(size_t index, std::vector<std::array<uint32_t, 3>>& triangles) const {
  const Block& own = m_blocks[index];
  const Place place = placeOf(m_keys[index]);
  for (const Crossing& crossing : own.crossings) {
    const size_t u = (crossing.axis + 1u) % 3, v = (crossing.axis + 2u) % 3;
    std::array<uint32_t, 4> corner{};
    static constexpr int kAround[4][2] = {{-1, -1}, {0, -1}, {0, 0}, {-1, 0}};
    bool whole = true;
    for (size_t k = 0; k < 4; ++k) {
      Place cell{crossing.cell[0], crossing.cell[1], crossing.cell[2]}, other = place;
      cell[u] += kAround[k][0], cell[v] += kAround[k][1];
      for (const size_t a : {u, v}) {
        if (cell[a] >= 0) continue;
        cell[a] += kCells;
        --other[a];
      }
      const Block* block = other == place ? &own : blockAt(other);
      const uint16_t point = !block || block->pointOfCell.empty()
                                 ? kNone
                                 : block->pointOfCell[static_cast<size_t>(cellIndex(cell[0], cell[1], cell[2]))];
      whole = whole && point != kNone;
      if (whole) corner[k] = block->first + point;
    }
    if (!whole) continue;
    if (!crossing.outwards) std::swap(corner[1], corner[3]);
    const auto apart = [&](size_t a, size_t b) {
      float sum = 0;
      for (size_t k = 0; k < 3; ++k) {
        const float d = m_surface.points[corner[a]][k] - m_surface.points[corner[b]][k];
        sum += d * d;
      }
      return sum;
    };
    if (apart(0, 2) <= apart(1, 3)) {
      triangles.push_back({corner[0], corner[1], corner[2]});
      triangles.push_back({corner[0], corner[2], corner[3]});
    } else {
      triangles.push_back({corner[0], corner[1], corner[3]});
      triangles.push_back({corner[1], corner[2], corner[3]});
    }
  }
}

/// Each point's, of the triangles around it by their areas.
void addNormals(ParticleSurface& surface) {
  surface.normals.assign(surface.points.size(), {});
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    askAt(i);
    const auto& [a, b, c] = surface.triangles[i];
    Point ab, ac;
    for (size_t k = 0; k < 3; ++k) {
      ab[k] = surface.points[b][k] - surface.points[a][k];
      ac[k] = surface.points[c][k] - surface.points[a][k];
    }
    const Point cross{ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]};
    for (const uint32_t point : {a, b, c})
      for (size_t k = 0; k < 3; ++k) surface.normals[point][k] += cross[k];
  }
  for (size_t i = 0; i < surface.normals.size(); ++i) {
    askAt(i);
    Point& n = surface.normals[i];
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length > 0)
      n = {n[0] / length, n[1] / length, n[2] / length};
    else
      n = {0, 1, 0};
  }
}

ParticleSurface Maker::make() {
  if (m_spheres.empty()) return {};
  m_grid.sort(m_spheres.size(), double{m_reach}, Period(), [&](size_t i) {
    const api::Float4& s = m_spheres[i];
    return api::Double3{double{s.x}, double{s.y}, double{s.z}};
  });
  advance(0);
  findBlocks();
  const auto inBlocks = [&](const auto& body) {
    for (size_t first = 0; first < m_blocks.size(); first += kSlice) {
      forChunks(std::min(kSlice, m_blocks.size() - first), 1, [&](size_t from, size_t to) {
        for (size_t i = first + from; i < first + to; ++i) body(i);
      });
      advance(0);
    }
  };
  inBlocks([&](size_t i) {
    Nodes nodes;
    fill(placeOf(m_keys[i]), nodes);
    findPoints(placeOf(m_keys[i]), nodes, m_blocks[i]);
  });
  for (Block& block : m_blocks) {
    block.first = static_cast<uint32_t>(m_surface.points.size());
    m_surface.points.insert(m_surface.points.end(), block.points.begin(), block.points.end());
    m_surface.values.insert(m_surface.values.end(), block.values.begin(), block.values.end());
  }
  std::vector<std::vector<std::array<uint32_t, 3>>> triangles(m_blocks.size());
  inBlocks([&](size_t i) { tie(i, triangles[i]); });
  for (const auto& part : triangles) m_surface.triangles.insert(m_surface.triangles.end(), part.begin(), part.end());
  addNormals(m_surface);
  return std::move(m_surface);
}

}  // namespace

ParticleSurface surfaceAround(std::span<const api::Float4> spheres, std::span<const float> values, double cell) {
  return Maker(spheres, values, cell).make();
}

}  // namespace ps
