// SPDX-License-Identifier: Apache-2.0
#include "core/sketch/flooding.h"

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/scene/scenewall.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <queue>
#include <string>
#include <unordered_set>
#include <vector>

namespace ps {
namespace {

struct CellHash {
  size_t operator()(const api::Cell& cell) const {
    uint64_t hash = 0;
    for (const int32_t part : {cell.x, cell.y, cell.z})
      hash = (hash ^ static_cast<uint32_t>(part)) * 0x9e3779b97f4a7c15ULL, hash ^= hash >> 29;
    return hash;
  }
};
struct CellEqual {
  bool operator()(const api::Cell& a, const api::Cell& b) const { return sameCell(a, b); }
};
using Cells = std::unordered_set<api::Cell, CellHash, CellEqual>;

constexpr std::array<api::Cell, 6> kFaces{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

api::Cell beside(const api::Cell& cell, const api::Cell& way) {
  return {cell.x + way.x, cell.y + way.y, cell.z + way.z};
}

/// A lattice with a way up, and the face of its cells that looks there the most.
struct Upright {
  Upright(const SketchGrid& lattice, const Vector3& gravity)
      : grid(lattice),
        up(gravity.norm() > 0 ? Vector3(-gravity.normalized()) : Vector3(0, 1, 0)),
        face(*std::max_element(kFaces.begin(), kFaces.end(),
                               [&](const api::Cell& a, const api::Cell& b) { return heightOf(a) < heightOf(b); })) {}
  double heightOf(const api::Cell& cell) const { return grid.centreOf(cell).dot(up); }

  const SketchGrid& grid;
  Vector3 up;
  api::Cell face;
};

/// All that would run full from one cell, and whether it has left the hollow there for the room that this stands in.
class Reached {
 public:
  /// `shores`: cells behind walls of the scene that it has met.
  Reached(const Upright& upright, const api::Cell& spring, const Cells& cells, const Cells& shores)
      : m_upright(upright),
        m_spring(spring),
        m_cells(cells),
        m_shores(shores),
        m_level(upright.heightOf(spring) + 1e-3 * upright.grid.spacing) {}

  bool hasLeft() const {
    if (std::none_of(m_cells.begin(), m_cells.end(), [&](const api::Cell& cell) { return isBank(cell); })) return false;
    const Room room = roomAround();
    if (room == Room::Closed) return true;
    const double half = 0.5 * m_upright.grid.spacing;
    // On top of a rim it may fall to either side.
    std::vector<api::Cell> starts{m_spring};
    for (const api::Cell& way : kFaces) {
      const api::Cell other = beside(m_spring, way);
      if (m_cells.count(other) && m_level - m_upright.heightOf(other) < half) starts.push_back(other);
    }
    return std::any_of(starts.begin(), starts.end(), [&](const api::Cell& start) {
      const auto rim = firstRim(start);
      return rim && (room == Room::None || m_level - rim->height < rim->height - rim->bottom - half);
    });
  }

 private:
  enum class Room { None, Closed, ToTheWalls };
  struct Rim {
    double height, bottom;  // of what stands below it
  };

  /// Beside a wall, which is no floor.
  bool isBank(const api::Cell& cell) const {
    const double least = m_upright.heightOf(cell) - 0.5 * m_upright.grid.spacing;
    return std::any_of(kFaces.begin(), kFaces.end(), [&](const api::Cell& way) {
      const api::Cell other = beside(cell, way);
      return m_shores.count(other) && m_upright.heightOf(other) > least;
    });
  }
  bool isOpen(const api::Cell& cell) const { return m_cells.count(cell) || m_upright.heightOf(cell) > m_level; }

  /// The nine cells of a level about one.
  template <class Call>
  bool allAbout(const api::Cell& cell, Call call) const {
    const api::Cell& up = m_upright.face;
    const api::Cell one = up.x ? api::Cell{0, 1, 0} : api::Cell{1, 0, 0};
    const api::Cell two = up.z ? api::Cell{0, 1, 0} : api::Cell{0, 0, 1};
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        const api::Cell other{cell.x + i * one.x + j * two.x, cell.y + i * one.y + j * two.y,
                              cell.z + i * one.z + j * two.z};
        if (!call(other)) return false;
      }
    }
    return true;
  }
  /// Three cells across and two high, or at the level: nothing of the kind is in a gap.
  bool isWide(const api::Cell& cell) const {
    const auto open = [&](const api::Cell& other) { return isOpen(other); };
    return m_cells.count(cell) && allAbout(cell, open) && allAbout(beside(cell, m_upright.face), open);
  }

  /// Where one comes from the spring without a narrow passage; none where it is in a narrow place itself.
  Room roomAround() const {
    Cells seen;
    std::vector<api::Cell> rim;
    const auto look = [&](const api::Cell& cell) {
      if (isWide(cell) && seen.insert(cell).second) rim.push_back(cell);
      return true;
    };
    const api::Cell& up = m_upright.face;
    allAbout(m_spring, look);
    allAbout({m_spring.x - up.x, m_spring.y - up.y, m_spring.z - up.z}, look);
    if (rim.empty()) return Room::None;
    while (!rim.empty()) {
      const api::Cell cell = rim.back();
      rim.pop_back();
      if (!allAbout(cell, [&](const api::Cell& other) { return !m_cells.count(other) || !isBank(other); }))
        return Room::ToTheWalls;
      for (const api::Cell& way : kFaces) look(beside(cell, way));
    }
    return Room::Closed;
  }

  /// Poured in at a cell it falls, and then rises: the first place where it falls again, unless it has come to the
  /// walls by then.
  std::optional<Rim> firstRim(const api::Cell& start) const {
    struct Next {
      double height;
      api::Cell cell;
      bool operator<(const Next& other) const {
        return height != other.height ? height > other.height : compareCells(cell, other.cell) > 0;
      }
    };
    const double step = m_upright.grid.spacing, none = std::numeric_limits<double>::infinity();
    std::priority_queue<Next> next;
    next.push({m_upright.heightOf(start), start});
    Cells seen{start};
    double lowest = none, risen = -none, bank = none;
    while (!next.empty()) {
      const auto [height, cell] = next.top();
      next.pop();
      if (height < risen - 0.9 * step) return Rim{risen, lowest};
      if (height > lowest + 1e-3 * step) risen = std::max(risen, height);
      lowest = std::min(lowest, height);
      if (isBank(cell)) bank = std::min(bank, std::max(risen, height));
      if (bank < risen) return std::nullopt;  // and no rim that comes is one before
      for (const api::Cell& way : kFaces) {
        const api::Cell other = beside(cell, way);
        if (m_cells.count(other) && seen.insert(other).second) next.push({m_upright.heightOf(other), other});
      }
    }
    return {};
  }

  const Upright& m_upright;
  const api::Cell m_spring;
  const Cells &m_cells, &m_shores;
  const double m_level;
};

class Flood {
 public:
  Flood(const SketchGrid& grid, const CellSet& filled, const Vector3& gravity, const FreeOf& freeOf, size_t most,
        const BarrierOf& barrierOf)
      : m_upright(grid, gravity),
        m_grid(grid),
        m_filled(filled),
        m_freeOf(freeOf),
        m_barrierOf(barrierOf),
        m_most(most) {}

  /// Free ones, the highest first.
  std::vector<api::Cell> springs(const CellSet& seeds) const {
    CellSet outside = seeds;
    outside.remove(m_filled.cells());
    CellSet free = m_freeOf(m_grid, outside), blocked = outside;
    blocked.remove(free.cells());
    std::vector<api::Cell> above;
    for (const api::Cell& cell : blocked.cells()) above.push_back(beside(cell, m_upright.face));
    CellSet raised(above);
    raised.remove(m_filled.cells());
    free.add(m_freeOf(m_grid, raised).cells());
    std::vector<api::Cell> order(free.cells().begin(), free.cells().end());
    std::stable_sort(order.begin(), order.end(),
                     [&](const api::Cell& a, const api::Cell& b) { return heightOf(a) > heightOf(b); });
    return order;
  }

  /// What is full already lets it through.
  void from(const api::Cell& spring) {
    if (m_wet.count(spring)) return;
    const double level = heightOf(spring) + 1e-3 * m_grid.spacing;  // turned lattices are level to rounding
    Cells seen{spring}, reached, shores;
    std::vector<api::Cell> rim{spring}, asked;
    while (!rim.empty()) {
      asked.clear();
      std::vector<api::Cell> next;
      for (const api::Cell& cell : rim) {
        if (!m_filled.contains(cell) && m_wet.insert(cell).second && isTooMuch()) refuse();
        if (m_barrierOf) reached.insert(cell);
        for (const api::Cell& way : kFaces) {
          const api::Cell other = beside(cell, way);
          if (heightOf(other) <= level && seen.insert(other).second)
            (m_filled.contains(other) ? next : asked).push_back(other);
        }
      }
      constexpr size_t kAtOnce = 256;  // cells, of which each is asked for between all walls
      for (size_t first = 0; first < asked.size(); first += kAtOnce) {
        const auto from = asked.begin() + static_cast<ptrdiff_t>(first);
        const auto to = asked.begin() + static_cast<ptrdiff_t>(std::min(asked.size(), first + kAtOnce));
        CellSet blocked(std::vector<api::Cell>(from, to));
        const CellSet free = m_freeOf(m_grid, blocked);
        blocked.remove(free.cells());
        meet(blocked, shores);
        next.insert(next.end(), free.cells().begin(), free.cells().end());
        advance(free.cells().size());
      }
      rim = std::move(next);
    }
    if (!shores.empty() && Reached(m_upright, spring, reached, shores).hasLeft()) refuseRoom();
  }

  CellSet wet() const { return CellSet(std::vector<api::Cell>(m_wet.begin(), m_wet.end())); }

 private:
  double heightOf(const api::Cell& cell) const { return m_upright.heightOf(cell); }
  void meet(const CellSet& blocked, Cells& shores) const {
    if (!m_barrierOf) return;
    for (const api::Cell& cell : blocked.cells()) {
      const Barrier barrier = m_barrierOf(m_grid, cell);
      if (barrier == Barrier::SceneEdge) refuseEdge();
      if (barrier == Barrier::Wall) shores.insert(cell);
    }
  }
  bool isTooMuch() const { return m_wet.size() + m_filled.size() > m_most; }
  [[noreturn]] void refuse() const {
    std::string most = std::to_string(m_most);
    for (size_t k = 3; k < most.size(); k += 4) most.insert(most.size() - k, ",");
    throw InputError("From here more than " + most +
                     " particles would run full, which is the most of one stroke. Close the gap where it is open; else "
                     "begin lower and go on above that with another stroke, or make the particle spacing larger");
  }
  [[noreturn]] static void refuseEdge() {
    throw InputError(
        "This hollow is open: from here all would run full as far as the edge of the scene. Close the gap, draw a "
        "lid, or begin lower");
  }
  [[noreturn]] static void refuseRoom() {
    throw InputError(
        "This hollow is open: from here the room around it would run full as well. Close the gap, or begin lower, "
        "below the gap or the rim");
  }

  const Upright m_upright;
  const SketchGrid& m_grid;
  const CellSet& m_filled;
  const FreeOf& m_freeOf;
  const BarrierOf& m_barrierOf;
  const size_t m_most;
  Cells m_wet;
};

}  // namespace

Barrier barrierIn(const Environment& environment, const SketchGrid& grid, const api::Cell& cell) {
  const Vector3 place = grid.centreOf(cell);
  const double radius = 0.49 * grid.spacing;  // as in isInScene()
  for (const SceneWall& wall : environment.walls) {
    // A wall in the bounds' own face comes before them, whatever the rounding.
    if (faceOf(wall).heightOf(place) < (1 + 1e-6) * radius) return Barrier::Wall;
  }
  for (int i = 0; i < 3; ++i) {
    const bool isOut =
        place[i] < environment.boundsMinimum[i] + radius || place[i] > environment.boundsMaximum[i] - radius;
    if (isOut) return environment.periodic[static_cast<size_t>(i)] ? Barrier::Wall : Barrier::SceneEdge;
  }
  return Barrier::Matter;
}

CellSet flooded(const SketchGrid& grid, const CellSet& seeds, const CellSet& filled, const Vector3& gravity,
                const FreeOf& freeOf, size_t most, const BarrierOf& barrierOf) {
  Flood flood(grid, filled, gravity, freeOf, most, barrierOf);
  for (const api::Cell& spring : flood.springs(seeds)) flood.from(spring);
  return flood.wet();
}

}  // namespace ps
