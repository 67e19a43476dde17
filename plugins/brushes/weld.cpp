// SPDX-License-Identifier: Apache-2.0
#include "weld.h"

#include "stamping.h"
#include "touching.h"

#include <string_view>

using namespace ps::brushes;

WeldBrush::WeldBrush()
    : Described(
          {"Weld",
           "Joins solid matter of bonded bodies that touches within the ball: two bodies, or what was cut apart. It is "
           "as strong there as within a body. Matter of locked bodies is left out; Ctrl cuts. Undo takes exactly "
           "these ties away.",
           ps::api::listOf(kWholeBall)}) {}

void WeldBrush::touch(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                      const ps::api::List<ps::api::StrokeSample>& samples, ps::api::TouchSink& sink) const {
  if (kind == ps::api::EditKind::Remove) return cutAlong(context, samples, parameter(context, 0, 0) > 0.5, sink);
  weldAlong(context, samples, sink);
}

ps::api::Double3 WeldBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* WeldBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kTouchesMatter ? static_cast<const ps::api::MatterBrush*>(this) : nullptr;
}
