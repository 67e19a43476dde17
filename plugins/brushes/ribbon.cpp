// SPDX-License-Identifier: Apache-2.0
#include "ribbon.h"

#include "frame.h"
#include "stamping.h"

#include <cmath>
#include <stdexcept>
#include <vector>

namespace {

using namespace ps::brushes;

constexpr double kPressureSize = 0.5;
constexpr ps::api::ParameterDeclaration kParameters[] = {pressureSize(
    kPressureSize, "How far a light touch of the pen makes the ribbon narrower; a mouse always presses fully.")};

/// Unit vector across the way, along what is drawn on.
Double3 across(const Frame& frame, const Double3& direction) {
  const Double3 side = cross(direction, frame.up);
  constexpr double kUpright = 1e-3;  // sine of the angle below which the way counts as up or down
  return norm(side) > kUpright ? unit(side) : frame.side;
}

}  // namespace

RibbonBrush::RibbonBrush()
    : Described(
          {"Ribbon",
           "Draws a band that lies on what is drawn on, one particle thick; half its width is the brush's radius. "
           "It begins as soon as the hand moves. It knows the lattice only, not what stands in the way; occupied "
           "cells are left as they are.",
           ps::api::listOf(kParameters)}) {}

void RibbonBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                         const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  const Frame frame = frameOf(context, 0);
  std::vector<ps::api::Cell>& cells = roomForCells();
  alongWay(context, samples, context.radius, [&](const Section& section) {
    if (dot(section.direction, section.direction) == 0) return;  // which way it goes is not known yet
    const double radius = pressedRadius(context, 0, kPressureSize, section.pressure);
    const Double3 side = across(frame, section.direction);
    const double steps = std::floor(radius / (context.spacing / 2));
    if (!(steps <= 2 * kMaxCells)) throw std::length_error("the ribbon is more than 1000 particles wide");
    cells.clear();
    for (double k = -steps; k <= steps; ++k)
      cells.push_back(cellAt(context, sum(section.centre, scaled(side, k * context.spacing / 2))));
    sink.submit(kind, {cells.data(), cells.size()});
  });
}

ps::api::Double3 RibbonBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return extentOf(frameOf(context, 0), {context.spacing / 2, context.radius, context.radius});
}
