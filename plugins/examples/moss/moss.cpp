// SPDX-License-Identifier: MIT
#include "moss.h"

#include <cmath>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace {

using namespace ps::api;

constexpr double kDepth = 1.5;      // cells from the middle of one particle to that of what grows on it
constexpr double kFastest = 0.5;    // m/s of the hand, from which on nothing takes root
constexpr double kMostCells = 100;  // from the middle of the brush to its rim

double squared(const Double3& a, const Double3& b) {
  const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  return x * x + y * y + z * z;
}

/// What moss knows of where cells lie.
struct Lattice {
  const StrokeContext& context;
  long index(double place, double origin) const { return std::lround((place - origin) / context.spacing); }
  Double3 centre(const Cell& cell) const {
    return {context.origin.x + cell.x * context.spacing, context.origin.y + cell.y * context.spacing,
            context.origin.z + cell.z * context.spacing};
  }
  /// Calls visit(cell) for the cells of a cube around a place, so many to each side of the one in the middle.
  template <class Visit>
  void around(const Double3& place, long cells, const Visit& visit) const {
    const long x = index(place.x, context.origin.x), y = index(place.y, context.origin.y),
               z = index(place.z, context.origin.z);
    for (long k = z - cells; k <= z + cells; ++k)
      for (long j = y - cells; j <= y + cells; ++j)
        for (long i = x - cells; i <= x + cells; ++i)
          visit(Cell{static_cast<int32_t>(i), static_cast<int32_t>(j), static_cast<int32_t>(k)});
  }
};

/// The cells of a ball around a sample that have matter beside them, some of them twice; all, where nobody knows the
/// scene. It goes by the matter, of which there is less than of cells.
std::vector<Cell> cellsAt(const StrokeContext& context, const StrokeSample& sample) {
  const Lattice lattice{context};
  const double radius = context.radius, depth = kDepth * context.spacing, far = radius + depth;
  std::vector<Cell> cells;
  const auto isInBall = [&](const Cell& cell) {
    return squared(lattice.centre(cell), sample.position) <= radius * radius;
  };
  if (!context.matter)
    lattice.around(sample.position, std::lround(std::ceil(radius / context.spacing)), [&](const Cell& cell) {
      if (isInBall(cell)) cells.push_back(cell);
    });
  for (size_t m = 0; context.matter && m < context.matter->count; ++m) {
    const Float4& p = context.matter->position[m];
    const Double3 place{p.x, p.y, p.z};
    if (squared(place, sample.position) > far * far) continue;
    lattice.around(place, std::lround(std::ceil(kDepth)), [&](const Cell& cell) {
      if (squared(lattice.centre(cell), place) <= depth * depth && isInBall(cell)) cells.push_back(cell);
    });
  }
  return cells;
}

}  // namespace

Moss::Moss()
    : Described({"Moss",
                 "Covers the matter under the brush with a layer, one or two particles thick, where the hand is slower "
                 "than half a metre a second. In the air it draws nothing.",
                 {}}) {}

double Moss::reach(const StrokeContext& context) const noexcept { return context.radius + kDepth * context.spacing; }

void Moss::stroke(const StrokeContext& context, EditKind kind, const List<StrokeSample>& samples,
                  EditSink& sink) const {
  if (!(context.radius <= kMostCells * context.spacing))
    throw std::length_error("the moss is more than 200 particles wide: make it smaller");
  for (size_t s = 0; s < samples.count; ++s) {
    const StrokeSample sample = samples.at(s);
    if (squared(sample.velocity, {0, 0, 0}) > kFastest * kFastest) continue;
    const std::vector<Cell> cells = cellsAt(context, sample);
    sink.submit(kind, {cells.data(), cells.size()});
  }
}

Double3 Moss::extent(const StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* Moss::extension(const char* name) const noexcept {
  return std::string_view(name) == kSeesMatter ? static_cast<const SeeingBrush*>(this) : nullptr;
}
