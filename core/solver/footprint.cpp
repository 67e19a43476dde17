// SPDX-License-Identifier: Apache-2.0
#include "core/solver/footprint.h"

#include "core/math/vector.h"
#include "core/particles/neighbours.h"
#include "core/solver/settings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

// Why a table beside the stages and not a sum that they give themselves: the answer is needed before there is a solver,
// and a test counts what is really allocated, so that a stage that takes more and does not say so here is found.
namespace ps {
namespace {

constexpr double kFloat = sizeof(float), kDouble = sizeof(double), kIndex = sizeof(uint32_t), kPlace = sizeof(size_t),
                 kPoint = sizeof(api::Float4), kMark = sizeof(uint8_t);
/// A vector that grows entry by entry has room for half as much again, in the mean.
constexpr double kGrown = 1.5;
/// Lists are given a thirty-second part more, by chunk and as a whole, and keep the room of the longest that there
/// were: of vapour in a closed vessel a third more than a lattice has.
constexpr double kBreathing = 1.4;
/// A grid has 8 cells per place at most, and mostly far fewer.
constexpr double kCells = 2;

/// Of the fields that the program itself keeps.
constexpr double kFields = 3 * kPoint + 9 * kFloat + kDouble + 2 * kMark;
/// Of the last good frame: fields and lists once more, in a buffer that grows by a quarter.
constexpr double kLastGood = 1.25;

/// Of every particle, by room.
constexpr double kStore = kGrown * (kFields + kIndex) + kPoint;
constexpr double kLists = 5 * kIndex + 3 * kFloat + kPoint + (3 + kCells) * kIndex;
constexpr double kDensity = 4 * kPoint + 6 * kFloat + 7 * kIndex + 2 * kMark;
constexpr double kViscosity = 3 * kFloat + kIndex + kPoint;
constexpr double kContacts = 2 * kPoint + 2 * kDouble + 12 * kIndex + 10 * kMark;
constexpr double kHeat = 14 * kDouble + 13 * kFloat + 6 * kIndex + 4 * kMark;
/// Rows of the implicit solver: two symmetric blocks, eight vectors, what it is asked.
constexpr double kImplicit = 8 * kPoint + 12 * kFloat + 8 * kFloat + 4 * kIndex + 2 * kMark;
/// A wall as a particle feels it, warm and radiating.
constexpr double kWall = 2 * kFloat;
/// Sixteen rays of what lies open, a fifth of all, as they meet others and back; its cube, in eight cells.
constexpr double kRays = 0.2 * 16 * (kIndex + kFloat + 2 * (kIndex + kFloat)) + 2 * kPlace + kFloat +
                         kGrown * (0.2 * (16 * kFloat + kIndex + 8 * 2 * kIndex) + 2 * kIndex) + kIndex;
/// Its cube as it is kept from frame to frame, and what others saw of it in the last one.
constexpr double kKeptBoxes = 14 * kFloat + 2 * kPlace + kDouble + 2 * kFloat + kPoint + 4 * kIndex + kMark;

/// Of every entry of a list.
constexpr double kEntry = kBreathing * kIndex;
/// Of what nothing holds, which may be a fluid: again where it is near, with its slope. Where there is heat: partner
/// and conductance, in the same room.
constexpr double kPairEntry = kBreathing * (kIndex + kFloat);
/// The watts of a model's own law.
constexpr double kPairLawEntry = kBreathing * kDouble;
constexpr double kImplicitEntry = kBreathing * kFloat;

/// Three snapshots (the newest, the one before, one in the making) with two fields, and what is drawn of them.
constexpr double kSnapshots = 3 * (kPoint + 6 * kFloat + 3 * kIndex + 2 * kMark) + 4 * kPoint;

/// Particles, values, the copy that edits are made in, the last good frame, the graph; a tie's key lies in a table
/// that is three eighths full or more.
double bytesOf(const StructureFootprint& s) {
  const bool ties = s.arity > 0;
  const double own = (ties ? static_cast<double>(s.arity) : 1) * kIndex + static_cast<double>(s.values) * kFloat;
  const double group = s.groupsPerMembership * (static_cast<double>(s.groupValues) * kFloat + 2 * kPlace);
  const double key = ties ? 2 * 2 * kPlace : 0;
  const double graph = kGrown * (ties ? 2 : 1) * kIndex;
  // Ties come and go one by one; groups are made at once, when it is known how many there are.
  return s.perParticle * ((ties ? kGrown : 1) * (own + group) + kLastGood * (own + group) + key + graph);
}

}  // namespace

double latticeNeighbours(const std::array<double, 3>& layers, double reach) {
  const int r = static_cast<int>(std::floor(reach));
  // Of all particles, those that have one `step` layers further.
  const auto share = [&](size_t axis, int step) { return std::max(0.0, 1 - std::abs(step) / layers[axis]); };
  double sum = 0;
  for (int z = -r; z <= r; ++z) {
    for (int y = -r; y <= r; ++y) {
      for (int x = -r; x <= r; ++x) {
        if (x * x + y * y + z * z <= reach * reach) sum += share(0, x) * share(1, y) * share(2, z);
      }
    }
  }
  return sum - 1;
}

double listedNeighbours(const std::array<double, 3>& layers, double reach, bool keepsShape) {
  const double lattice = latticeNeighbours(layers, reach);
  return keepsShape ? lattice : std::max(lattice, 4.0 / 3 * std::numbers::pi * reach * reach * reach);
}

double bytesPerParticle(const MatterFootprint& matter) {
  // Lists are padded, by half a vector in the mean.
  const double entries = matter.neighbours + Neighbours::kListPad / 2.0;
  double bytes = kStore + (kGrown + kLastGood) * matter.fieldBytes + kLastGood * (kFields + kPoint) + kLists +
                 kDensity + kViscosity + kContacts + kSnapshots + entries * kEntry;
  const bool fluid = matter.structures.empty() && !matter.dry;
  if (fluid || matter.heat) bytes += entries * kPairEntry;
  if (matter.heat) bytes += kHeat + kWall * matter.walls;
  if (matter.heat && matter.pairLaw) bytes += entries * kPairLawEntry;
  if (matter.heat && matter.radiation) bytes += kRays + kKeptBoxes;
  if (matter.thick) bytes += kImplicit + entries * kImplicitEntry;
  for (const StructureFootprint& structure : matter.structures) bytes += bytesOf(structure);
  return bytes;
}

double bytesPerScene(size_t materials, bool radiation) {
  constexpr double kTables = 48 * 2048 * kDouble;  // properties over temperature
  constexpr double kRayGrid = (1 << 22) * kIndex, kSmallGrids = 1 << 20;
  return static_cast<double>(materials) * kTables + kSmallGrids + (radiation ? kRayGrid : 0);
}

}  // namespace ps
