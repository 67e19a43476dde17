// SPDX-License-Identifier: Apache-2.0
#include "stamp.h"

#include "frame.h"
#include "stamping.h"
#include "turned.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>
#include <vector>

namespace {

using namespace ps::brushes;
using ps::api::Cell;
using ps::api::ParameterKind;
using ps::api::Scale;

constexpr double kPi = 3.14159265358979323846;
enum : size_t { kScale, kFits, kRotation, kTip, kDistance, kFollows };
constexpr ps::api::ParameterDeclaration kParameters[] = {
    ps::api::actingWhen("fits = off", {"scale", "Scale", "", "", ParameterKind::Number, Scale::Logarithmic, 1, 0.1, 10,
                                       0.01, 100, "%", 100, 0, "", "Brush", "How large the copies are.",
                                       "100 % as large as the body, 50 % half as long", ""}),
    {"fits", "As large as the brush", "", "", ParameterKind::Toggle, Scale::Linear, 0, 0, 1, 0, 1, "", 1, 0, "",
     "Brush", "Half the longest edge of a copy is the brush's radius, whatever the body measures.",
     "off: scaled from the body, on: [ and ] make it smaller and larger", ""},
    rotation(kPi, "Turns the copies about the up direction.", "0° as the body stands, 90° a quarter turn"),
    {"tip", "Tipped", "", "rad", ParameterKind::Number, Scale::Linear, 0, -kPi, kPi, -2 * kPi, 2 * kPi, "°", 180 / kPi,
     0, "", "Brush", "Tips the copies over, about a level axis, before they are turned.",
     "90° a cup that lies on its side, 180° upside down", ""},
    {"distance", "Distance of copies", "", "", ParameterKind::Number, Scale::Linear, 1, 0, 4, 0, 100, "%", 100, 0, "",
     "Brush", "How far a hand that goes on leads from copy to copy, in their longest edges.",
     "100 % side by side, 0 % one strand of them", ""},
    kFollowing,
};

/// A copy, as a stroke would put it where the hand is turned so.
struct Copy {
  Double3 x, y, z;  ///< unit vectors along its cells
  double cell;      ///< m, edge of one
  Double3 half;     ///< m, of the box around it
};

Copy copyOf(const ps::api::StrokeContext& context, const Double3& turn) {
  const double longest = 2 * std::max({context.shapeHalf.x, context.shapeHalf.y, context.shapeHalf.z});
  const bool fits = parameter(context, kFits, 0) != 0;
  Copy copy{context.shapeX,
            context.shapeY,
            context.shapeZ,
            fits ? 2 * context.radius / longest : context.shapeSpacing * parameter(context, kScale, 1),
            {0, 0, 0}};
  const Double3 heldTurn = following(turn, context.up, parameter(context, kFollows, kFollowsRotation));
  for (Double3* axis : {&copy.x, &copy.y, &copy.z}) {
    // In a mirror side and front change their sense together with up, so that it is the mirror image that is drawn.
    *axis = alongFrame(context, *axis, parameter(context, kTip, 0), parameter(context, kRotation, 0));
    *axis = turned(*axis, heldTurn);
  }
  copy.half = extentOf({copy.x, copy.y, copy.z}, scaled(context.shapeHalf, copy.cell));
  return copy;
}

bool holds(const ps::api::Span<const Cell>& shape, const Cell& cell) {
  const auto key = [](const Cell& c) { return std::tuple(c.z, c.y, c.x); };
  return std::binary_search(shape.begin(), shape.end(), cell,
                            [&](const Cell& a, const Cell& b) { return key(a) < key(b); });
}

/// The cells whose centres lie in those of the copy. Where its cells are smaller than those of the lattice those that
/// hold the centre of one as well, so that thin walls stay closed.
void addCells(const ps::api::StrokeContext& context, const Copy& copy, const Double3& place, std::vector<Cell>& cells) {
  // A hair aside, so that centres on faces do not waver between two cells: a copy as it is has as many as the body.
  const auto at = [&](const Double3& d, const Double3& axis, double middle) {
    return static_cast<int32_t>(std::floor(dot(d, axis) / copy.cell + middle + 0.5 - kHair));
  };
  const Double3& m = context.shapeMiddle;
  const auto inside = [&](const Double3& d) {
    return holds(context.shape, {at(d, copy.x, m.x), at(d, copy.y, m.y), at(d, copy.z, m.z)});
  };
  cellsAround(context, place, copy.half, inside, cells);
  if (!(copy.cell < context.spacing * (1 - kHair))) return;
  for (const Cell& c : context.shape) {
    const Double3 own = sum(sum(scaled(copy.x, c.x - m.x), scaled(copy.y, c.y - m.y)), scaled(copy.z, c.z - m.z));
    cells.push_back(cellAt(context, sum(place, scaled(own, copy.cell))));
  }
}

}  // namespace

StampBrush::StampBrush()
    : Described({"Stamp",
                 "Puts a copy of the body that is selected, of the material that is chosen, and more of them along the "
                 "way of the hand. A copy has the shape that the body has at the start, at any size and turned as you "
                 "like. Alt with a click takes another body's shape and material. It knows the lattice only, not what "
                 "stands in the way; occupied cells are left as they are.",
                 ps::api::listOf(kParameters)}) {}

void StampBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                        const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  if (context.shape.size == 0) return;
  std::vector<Cell>& cells = roomForCells();
  const auto put = [&](const Double3& place, const Double3& turn) {
    cells.clear();
    addCells(context, copyOf(context, turn), place, cells);
    sink.submit(kind, {cells.data(), cells.size()});
  };
  const double edge = 2 * std::max({context.shapeHalf.x, context.shapeHalf.y, context.shapeHalf.z});
  const double step =
      std::max(context.spacing, parameter(context, kDistance, 1) * edge * copyOf(context, {0, 0, 0}).cell);
  for (size_t s = 0; s < samples.count; ++s) {
    const ps::api::StrokeSample sample = samples.at(s);
    if (sample.way == 0) put(sample.position, sample.turn);
    if (s == 0) continue;
    const ps::api::StrokeSample last = samples.at(s - 1);
    for (double k = std::floor(last.way / step) + 1; k * step <= sample.way; ++k) {
      const double t = (k * step - last.way) / (sample.way - last.way);
      put(sum(scaled(last.position, 1 - t), scaled(sample.position, t)), sample.turn);
    }
  }
}

ps::api::Double3 StampBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  if (context.shape.size == 0) return {context.radius, context.radius, context.radius};
  return copyOf(context, {0, 0, 0}).half;
}

const void* StampBrush::extension(const char* name) const noexcept {
  const std::string_view asked(name);
  return asked == ps::api::kStampsShape || asked == ps::api::kBoxStamp ? this : nullptr;
}
