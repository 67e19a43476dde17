// SPDX-License-Identifier: Apache-2.0
#include "cube.h"

#include "stamp.h"

#include <array>
#include <cmath>
#include <string_view>

namespace {

using ps::api::Double3;
using ps::api::ParameterDeclaration;
using ps::api::ParameterKind;
using ps::api::Scale;

constexpr double kPi = 3.14159265358979323846;

constexpr ParameterDeclaration kParameters[] = {
    {"rotation", "Rotation", "", "rad", ParameterKind::Number, Scale::Linear, 0, -kPi / 4, kPi / 4, -2 * kPi, 2 * kPi,
     "°", 180 / kPi, 0, "", "Brush", "Turns the cube about the up direction.", "0° along the axes, 45° on its corner",
     ""},
};

double dot(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Double3 cross(const Double3& a, const Double3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Double3 scaled(const Double3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
Double3 sum(const Double3& a, const Double3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

/// The cube's edges as unit vectors: up, and two across it, at rotation 0 as near to the world's axes as up allows.
std::array<Double3, 3> axesOf(const ps::api::StrokeContext& context) {
  const double length = std::sqrt(dot(context.up, context.up));
  const Double3 up = length > 0 ? scaled(context.up, 1 / length) : Double3{0, 1, 0};
  const Double3 helper = std::abs(up.x) < 0.9 ? Double3{1, 0, 0} : Double3{0, 1, 0};
  Double3 side = sum(helper, scaled(up, -dot(helper, up)));
  side = scaled(side, 1 / std::sqrt(dot(side, side)));
  const Double3 front = cross(side, up);
  const double angle = ps::brushes::parameter(context, 0, 0);
  const double c = std::cos(angle), s = std::sin(angle);
  return {up, sum(scaled(side, c), scaled(front, s)), sum(scaled(side, -s), scaled(front, c))};
}

Double3 extentOf(const std::array<Double3, 3>& axes, double half) {
  Double3 extent{0, 0, 0};
  for (const Double3& a : axes) extent = sum(extent, scaled({std::abs(a.x), std::abs(a.y), std::abs(a.z)}, half));
  return extent;
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
  const std::array<Double3, 3> axes = axesOf(context);
  const Double3 extent = extentOf(axes, context.radius);
  // Half open, so that an edge of n spacings holds n cells wherever it starts; the allowance is far above rounding.
  const double low = -context.radius - 1e-9 * context.spacing, high = context.radius - 1e-9 * context.spacing;
  std::vector<ps::api::Cell> cells;
  for (size_t s = 0; s < samples.count; ++s) {
    const ps::api::StrokeSample sample = samples.at(s);
    cells.clear();
    ps::brushes::stamp(
        context, sample.position, extent,
        [&](const Double3& d) {
          for (const Double3& axis : axes)
            if (const double along = dot(d, axis); along < low || along >= high) return false;
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
