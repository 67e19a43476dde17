// SPDX-License-Identifier: Apache-2.0
#include "sphere.h"

#include "balls.h"

SphereBrush::SphereBrush()
    : Described({"Sphere",
                 "Draws a round strand: every cell whose centre is within the radius of the stroke is filled, or "
                 "emptied. It knows the lattice only, not what stands in the way; occupied cells are left as they are.",
                 ps::api::listOf(ps::brushes::kBallParameters)}) {}

void SphereBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                         const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  ps::brushes::submitBalls(context, kind, samples, sink);
}

ps::api::Double3 SphereBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}
