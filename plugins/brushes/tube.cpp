// SPDX-License-Identifier: Apache-2.0
#include "tube.h"

#include "frame.h"
#include "stamping.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace ps::brushes;

constexpr double kPressureSize = 0.5, kWall = 2;
constexpr ps::api::ParameterDeclaration kParameters[] = {
    pressureSize(kPressureSize,
                 "How far a light touch of the pen makes the tube narrower; a mouse always presses "
                 "fully."),
    {"wall", "Wall", "", "", ps::api::ParameterKind::Integer, ps::api::Scale::Linear, kWall, 1, 8, 1, 100, "", 1, 0, "",
     "Brush", "Thickness of the tube's wall in particles; as thick as the tube, it is a solid strand.",
     "2 holds water, 3 holds together when it is bent", ""},
};

}  // namespace

TubeBrush::TubeBrush()
    : Described({"Tube",
                 "Draws a hollow strand around the stroke, open at both ends; the brush's radius is its outer one. It "
                 "begins as soon as the hand moves. Where a bend is tighter than the tube, its walls meet inside. It "
                 "knows the lattice only, not what stands in the way; occupied cells are left as they are.",
                 ps::api::listOf(kParameters)}) {}

void TubeBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                       const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  const double dx = context.spacing, wall = parameter(context, 1, kWall) * dx;
  std::vector<ps::api::Cell>& cells = roomForCells();
  alongWay(context, samples, context.radius, [&](const Section& section) {
    if (dot(section.direction, section.direction) == 0) return;  // which way it goes is not known yet
    const double radius = std::max(pressedRadius(context, 0, kPressureSize, section.pressure), dx / 2);
    const double outer = radius * radius * (1 + 1e-9), hole = std::max(0.0, radius - wall);
    const double inner = hole * hole * (1 - 1e-9);
    cells.clear();
    const auto inside = [&](const Double3& d) {
      const double along = dot(d, section.direction), off = dot(d, d) - along * along;
      return std::abs(along) <= dx / 2 && off <= outer && (hole == 0 || off >= inner);
    };
    const double reach = radius + dx;
    cellsAround(context, section.centre, {reach, reach, reach}, inside, cells);
    if (cells.empty() && hole == 0) cells.push_back(cellAt(context, section.centre));  // a strand thinner than a cell
    sink.submit(kind, {cells.data(), cells.size()});
  });
}

ps::api::Double3 TubeBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}
