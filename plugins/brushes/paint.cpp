// SPDX-License-Identifier: Apache-2.0
#include "paint.h"

#include "balls.h"

#include <string_view>

PaintBrush::PaintBrush()
    : Described({"Paint",
                 "Makes the matter within the ball of the material that is chosen, as warm as it is: what cannot be "
                 "solid or liquid of it at that temperature melts, freezes or boils. It fills as much room, so that "
                 "its mass is another one; the heat that this takes or leaves is counted as a source. Matter of "
                 "locked bodies stays as it is.",
                 ps::api::listOf(ps::brushes::kBallParameters)}) {}

void PaintBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                        const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  const auto painted = kind == ps::api::EditKind::Remove ? kind : ps::api::EditKind::Paint;
  ps::brushes::submitBalls(context, painted, samples, sink);
}

ps::api::Double3 PaintBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* PaintBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kPaintsMatter ? this : nullptr;
}
