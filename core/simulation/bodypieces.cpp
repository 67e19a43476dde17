// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/bodypieces.h"

#include "core/simulation/engine.h"
#include "core/simulation/lattice.h"
#include "core/simulation/restplaces.h"
#include "core/sketch/cellset.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace ps {
namespace {

constexpr double kTouch = 1.75;  // spacings: corner to corner of two cells, and as much as matter stretches
constexpr size_t kPiece = 4;     // particles, as of the quantity "pieces"

/// Who hangs together with whom, by the lowest of each.
class Sets {
 public:
  explicit Sets(size_t count) : m_first(count) { std::iota(m_first.begin(), m_first.end(), size_t{0}); }
  size_t of(size_t k) {
    while (m_first[k] != k) k = m_first[k] = m_first[m_first[k]];
    return k;
  }
  void join(size_t a, size_t b) {
    a = of(a), b = of(b);
    m_first[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<size_t> m_first;
};

/// Pairs of places within a distance, each once.
template <class Visit>
void eachNear(const std::vector<Vector3>& places, double distance, const Visit& visit) {
  std::vector<std::pair<CellIndex, size_t>> sorted;
  for (size_t k = 0; k < places.size(); ++k) {
    const Vector3 cell = places[k] / distance;
    sorted.push_back({{static_cast<int>(std::floor(cell.x())), static_cast<int>(std::floor(cell.y())),
                       static_cast<int>(std::floor(cell.z()))},
                      k});
  }
  std::sort(sorted.begin(), sorted.end());
  for (const auto& [cell, k] : sorted) {
    for (int n = 0; n < 9; ++n) {
      // Rows of three cells: their last index runs.
      const CellIndex from{cell[0] + n % 3 - 1, cell[1] + n / 3 - 1, cell[2] - 1}, to{from[0], from[1], cell[2] + 1};
      auto other = std::lower_bound(sorted.begin(), sorted.end(), std::pair(from, size_t{0}));
      for (; other != sorted.end() && other->first <= to; ++other) {
        if (other->second > k && (places[other->second] - places[k]).squaredNorm() <= distance * distance)
          visit(k, other->second);
      }
    }
  }
}

/// A body's particles by their rows in the scene, and where they are.
struct Matter {
  std::vector<size_t> rows;
  std::vector<Vector3> places;  ///< m
  std::vector<uint32_t> tie;    ///< Solver::pieces() of each
};

Matter matterOf(const TiedScene& moment, const std::string& body) {
  const Snapshot& scene = *moment.scene;
  const std::vector<std::string>& ids = *scene.bodyIds;
  const auto index = static_cast<uint32_t>(std::find(ids.begin(), ids.end(), body) - ids.begin());
  Matter matter;
  for (size_t i = 0; i < scene.id.size(); ++i) {
    if (scene.body[i] != index) continue;
    matter.rows.push_back(i);
    matter.places.push_back(vectorOf(scene.position[i]));
    matter.tie.push_back(moment.ties[i]);
  }
  return matter;
}

/// For each particle the number of its piece, in order of their sizes.
std::vector<size_t> numbered(const Matter& matter, double touch, bool byTiesAlone) {
  const size_t count = matter.rows.size();
  Sets sets(count);
  const auto isTied = [&](size_t k) { return matter.tie[k] != Solver::kNoPiece; };
  if (byTiesAlone) {
    std::map<uint32_t, size_t> first;
    for (size_t k = 0; k < count; ++k) {
      if (isTied(k)) sets.join(k, first.try_emplace(matter.tie[k], k).first->second);
    }
  }
  eachNear(matter.places, touch, [&](size_t a, size_t b) {
    if (matter.tie[a] == matter.tie[b]) sets.join(a, b);
  });
  std::vector<size_t> size(count);
  for (size_t k = 0; k < count; ++k) ++size[sets.of(k)];
  const auto isPiece = [&](size_t k, bool tied) { return isTied(k) == tied && size[sets.of(k)] >= kPiece; };
  bool tied = false;
  for (size_t k = 0; k < count && !tied; ++k) tied = isPiece(k, true);
  // The rest goes with what it touches, the lowest of them, and what touches none with the largest.
  std::vector<size_t> goes(count, count);
  for (size_t k = 0; k < count; ++k) {
    if (isPiece(k, tied)) goes[sets.of(k)] = sets.of(k);
  }
  std::vector<size_t> home = goes;
  eachNear(matter.places, touch, [&](size_t a, size_t b) {
    const size_t from = sets.of(a), to = sets.of(b);
    if (goes[from] == count && goes[to] < count) home[from] = std::min(home[from], goes[to]);
    if (goes[to] == count && goes[from] < count) home[to] = std::min(home[to], goes[from]);
  });
  std::vector<size_t> pieces;
  for (size_t k = 0; k < count; ++k) {
    if (goes[k] == k) pieces.push_back(k);
  }
  std::stable_sort(pieces.begin(), pieces.end(), [&](size_t a, size_t b) { return size[a] > size[b]; });
  std::vector<size_t> number(count, 0), place(count + 1, 0);
  for (size_t n = 0; n < pieces.size(); ++n) place[pieces[n]] = n;
  for (size_t k = 0; k < count; ++k) number[k] = place[home[sets.of(k)]];
  return number;
}

/// The cells of a sketch that a particle was made of: where particles stand farther apart than its cells, all that lie
/// about it.
void addCells(std::vector<api::Cell>& cells, const VoxelShape& voxels, double spacing, const Vector3& rest) {
  const SketchGrid drawn{voxels.origin, voxels.spacing}, made{resampledOrigin(voxels, spacing), spacing};
  if (spacing < voxels.spacing * (1 + 1e-9)) return cells.push_back(drawn.cellAt(rest));
  const api::Cell cell = made.cellAt(rest);
  const CellIndex at{cell.x, cell.y, cell.z};
  for (const CellIndex& c : resampled({at}, spacing, voxels.spacing)) cells.push_back({c[0], c[1], c[2]});
}

}  // namespace

TiedScene tiedScene(const Engine& engine) { return {engine.snapshot(), engine.solver().pieces()}; }

bool isSolid(const TiedScene& moment, const std::string& body) {
  const std::vector<size_t> rows = matterOf(moment, body).rows;
  return std::any_of(rows.begin(), rows.end(), [&](size_t row) { return api::holds(moment.scene->motion[row]); });
}

bool mayComeApart(const Body& body) {
  return std::holds_alternative<VoxelShape>(body.shape) && !body.locked &&
         !toggleOf(body.parameters, bodyParameters(), "fixed");
}

std::vector<CellIndices> piecesOf(const TiedScene& moment, const Body& body) {
  const auto* voxels = std::get_if<VoxelShape>(&body.shape);
  const Snapshot& now = *moment.scene;
  if (!voxels || !now.rest) return {};
  const Matter matter = matterOf(moment, body.id);
  const std::vector<size_t> number = numbered(matter, kTouch * now.spacing, now.period.any());
  std::vector<std::vector<api::Cell>> cells(number.empty() ? 0 : *std::max_element(number.begin(), number.end()) + 1);
  for (size_t k = 0; k < number.size(); ++k) {
    if (const auto rest = now.rest->of(now.id[matter.rows[k]])) addCells(cells[number[k]], *voxels, now.spacing, *rest);
  }
  std::vector<CellIndices> pieces;
  CellSet taken;  // a cell whose matter has melted away may have been drawn again
  for (const std::vector<api::Cell>& all : cells) {
    CellSet own(all);
    own.remove(taken.cells());
    taken.add(own.cells());
    pieces.push_back(own.indices());
  }
  return pieces;
}

std::vector<CellIndices> cutOff(const std::vector<CellIndices>& before, const std::vector<CellIndices>& after,
                                size_t least) {
  std::vector<std::pair<CellIndex, size_t>> known;
  for (size_t k = 0; k < before.size(); ++k) {
    for (const CellIndex& cell : before[k]) known.emplace_back(cell, k);
  }
  std::sort(known.begin(), known.end());
  std::vector<bool> isThere(before.size());  // a piece that it has come to; the first of each is the largest
  std::vector<CellIndices> off;
  for (const CellIndices& piece : after) {
    if (piece.size() < least) continue;
    std::vector<size_t> shares(before.size());
    for (const CellIndex& cell : piece) {
      const auto found = std::lower_bound(known.begin(), known.end(), std::pair(cell, size_t{0}));
      if (found != known.end() && found->first == cell) ++shares[found->second];
    }
    const auto most = std::max_element(shares.begin(), shares.end());
    if (most == shares.end() || *most == 0) continue;
    const auto from = static_cast<size_t>(most - shares.begin());
    if (isThere[from]) off.push_back(piece);
    isThere[from] = true;
  }
  return off;
}

}  // namespace ps
