// SPDX-License-Identifier: Apache-2.0
#include "smooth.h"

#include "balls.h"

#include <string_view>

SmoothBrush::SmoothBrush()
    : Described({"Smooth",
                 "Rounds what was drawn, before the first step: edges and bumps within the ball go, hollows are "
                 "filled with what is around them. Flat faces stay, and so does what is one particle thick. A second "
                 "stroke rounds further. Locked bodies stay as they are; Ctrl erases.",
                 ps::api::listOf(ps::brushes::kBallParameters)}) {}

void SmoothBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                         const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  const auto smoothed = kind == ps::api::EditKind::Remove ? kind : ps::api::EditKind::Smooth;
  ps::brushes::submitBalls(context, smoothed, samples, sink);
}

ps::api::Double3 SmoothBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* SmoothBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kSmoothsMatter ? this : nullptr;
}
