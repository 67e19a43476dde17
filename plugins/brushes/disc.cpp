// SPDX-License-Identifier: Apache-2.0
#include "disc.h"

#include "sheet.h"
#include "stamping.h"
#include "turned.h"

namespace {

constexpr ps::api::ParameterDeclaration kParameters[] = {ps::brushes::kFollowing};

}  // namespace

DiscBrush::DiscBrush()
    : Described(
          {"Disc",
           "Draws with a round sheet, one particle thick, that lies on what is drawn on: the bottom of a cup at a "
           "touch. It knows the lattice only, not what stands in the way; occupied cells are left as they are.",
           ps::api::listOf(kParameters)}) {}

void DiscBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                       const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  // Centres on the rim count, as they do for the ball.
  const double limit = context.radius * context.radius * (1 + 1e-9);
  const auto inside = [&](double side, double front) { return side * side + front * front <= limit; };
  ps::brushes::stampSheets(context, ps::brushes::frameOf(context, 0),
                           ps::brushes::parameter(context, 0, ps::brushes::kFollowsRotation), context.radius, samples,
                           kind, inside, sink);
}

ps::api::Double3 DiscBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return ps::brushes::extentOf(ps::brushes::frameOf(context, 0), {context.spacing / 2, context.radius, context.radius});
}
