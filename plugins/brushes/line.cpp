// SPDX-License-Identifier: Apache-2.0
#include "line.h"

#include "frame.h"
#include "stamping.h"
#include "turned.h"

#include <cmath>
#include <string_view>
#include <vector>

namespace {

using namespace ps::brushes;

constexpr ps::api::ParameterDeclaration kParameters[] = {
    rotation(1.5707963267948966, "Turns the row about the up direction.", "0° along x, 90° along z")};

}  // namespace

LineBrush::LineBrush()
    : Described({"Line",
                 "Draws with a row of particles, whose half length is the brush's radius: across it a stroke makes a "
                 "sheet, along it a thread. It knows the lattice only, not what stands in the way; occupied cells are "
                 "left as they are.",
                 ps::api::listOf(kParameters)}) {}

void LineBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                       const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  const Frame frame = frameOf(context, parameter(context, 0, 0));
  const double dx = context.spacing, hair = kHair * dx;
  const Double3 extent = extentOf(frame, {dx, context.radius, dx});
  std::vector<ps::api::Cell>& cells = roomForCells();
  alongWay(context, samples, 0, [&](const Section& section) {
    cells.clear();
    const auto inside = [&](const Double3& d) {
      const double along = dot(d, frame.side);
      const Double3 off = difference(d, scaled(frame.side, along));
      return reaches(along, context.radius, hair) && reaches(off.x, dx / 2, hair) && reaches(off.y, dx / 2, hair) &&
             reaches(off.z, dx / 2, hair);
    };
    cellsAround(context, section.centre, extent, inside, cells);
    if (cells.empty()) cells.push_back(cellAt(context, section.centre));  // smaller than a cell
    sink.submit(kind, {cells.data(), cells.size()});
  });
}

ps::api::Double3 LineBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  const double half = context.spacing / 2;
  return extentOf(frameOf(context, parameter(context, 0, 0)), {half, context.radius, half});
}

const void* LineBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kBoxStamp ? this : nullptr;
}
