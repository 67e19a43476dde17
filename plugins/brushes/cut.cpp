// SPDX-License-Identifier: Apache-2.0
#include "cut.h"

#include "stamping.h"
#include "touching.h"

#include <string_view>

using namespace ps::brushes;

CutBrush::CutBrush()
    : Described(
          {"Cut",
           "Cuts solid matter apart along the way of the hand, as deep as the ball reaches: bonded and soft bodies, "
           "rigid ones, cloth and rope. Nothing joins again there by itself before it has melted. Matter of "
           "locked bodies stays whole; Ctrl welds. Undo ties the same particles again, but for crumbs of rigid bodies.",
           ps::api::listOf(kWholeBall)}) {}

void CutBrush::touch(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                     const ps::api::List<ps::api::StrokeSample>& samples, ps::api::TouchSink& sink) const {
  if (kind == ps::api::EditKind::Remove) return weldAlong(context, samples, sink);
  cutAlong(context, samples, parameter(context, 0, 0) > 0.5, sink);
}

ps::api::Double3 CutBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* CutBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kTouchesMatter ? static_cast<const ps::api::MatterBrush*>(this) : nullptr;
}
