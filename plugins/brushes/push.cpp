// SPDX-License-Identifier: Apache-2.0
#include "push.h"

#include "stamping.h"
#include "touching.h"

#include "vectors.h"
#include <string_view>

namespace {

using namespace ps::brushes;
using ps::api::StrokeContext;

constexpr double kForce = 50, kFalloff = 0.5, kFastest = 20;  // m/s
constexpr ps::api::ParameterDeclaration kParameters[] = {
    forceOf(kForce, "The most that the hand pushes with, all matter within the ball together."), fallingOff(kFalloff)};

}  // namespace

PushBrush::PushBrush()
    : Described({"Push",
                 "Takes the matter around the hand along with it, as fast as the hand goes; a hand that rests does "
                 "nothing. Fixed matter and that of locked bodies stays. No step of undo: the timeline goes back to "
                 "before.",
                 ps::api::listOf(kParameters)}) {}

void PushBrush::touch(const StrokeContext& context, ps::api::EditKind kind,
                      const ps::api::List<ps::api::StrokeSample>& samples, ps::api::TouchSink& sink) const {
  const double force = parameter(context, 0, kForce), sign = kind == ps::api::EditKind::Remove ? -1 : 1;
  touchAlong(context, samples, parameter(context, 1, kFalloff), sink,
             [&](const ps::api::StrokeSample& sample, ps::api::Touch& touch) {
               const double speed = norm(sample.velocity);
               if (!(speed > 0)) return;
               touch.kind = ps::api::TouchKind::Push;
               touch.force = force * sample.pressure;
               touch.velocity = scaled(sample.velocity, sign * (speed > kFastest ? kFastest / speed : 1));
             });
}

ps::api::Double3 PushBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* PushBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kTouchesMatter ? static_cast<const ps::api::MatterBrush*>(this) : nullptr;
}
