// SPDX-License-Identifier: Apache-2.0
#include "cube.h"

#include "frame.h"
#include "stamping.h"
#include "turned.h"

#include <string_view>
#include <vector>

namespace {

using ps::api::Double3;

constexpr ps::api::ParameterDeclaration kParameters[] = {
    ps::brushes::rotation(0.78539816339744831, "Turns the cube about the up direction.",
                          "0° along the axes, 45° on its corner"),
    ps::brushes::kFollowing};

/// The cube's edges as unit vectors.
ps::brushes::Frame axesOf(const ps::api::StrokeContext& context) {
  return ps::brushes::frameOf(context, ps::brushes::parameter(context, 0, 0));
}

Double3 extentOf(const ps::brushes::Frame& frame, double half) {
  return ps::brushes::extentOf(frame, {half, half, half});
}

}  // namespace

CubeBrush::CubeBrush()
    : Described({"Cube",
                 "Draws a square strand: a cube, whose half edge is the brush's radius, is filled or emptied at every "
                 "point of the stroke. A cube of n particle spacings holds n cells along each edge. It knows the "
                 "lattice only, not what stands in the way; occupied cells are left as they are.",
                 ps::api::listOf(kParameters)}) {}

void CubeBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                       const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  const ps::brushes::Frame upright = axesOf(context);
  const double how = ps::brushes::parameter(context, 1, ps::brushes::kFollowsRotation);
  // Half open, so that an edge of n spacings holds n cells wherever it starts; the allowance is far above rounding.
  const double low = -context.radius - 1e-9 * context.spacing, high = context.radius - 1e-9 * context.spacing;
  std::vector<ps::api::Cell>& cells = ps::brushes::roomForCells();
  for (size_t s = 0; s < samples.count; ++s) {
    const ps::api::StrokeSample sample = samples.at(s);
    const ps::brushes::Frame frame = ps::brushes::held(upright, sample.turn, how);
    cells.clear();
    ps::brushes::stamp(
        context, sample.position, extentOf(frame, context.radius),
        [&](const Double3& d) {
          for (const Double3& axis : {frame.up, frame.side, frame.front})
            if (const double along = ps::brushes::dot(d, axis); along < low || along >= high) return false;
          return true;
        },
        cells);
    sink.submit(kind, {cells.data(), cells.size()});
  }
}

ps::api::Double3 CubeBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return extentOf(axesOf(context), context.radius);
}

const void* CubeBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kBoxStamp ? this : nullptr;
}
