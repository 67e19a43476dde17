// SPDX-License-Identifier: Apache-2.0
#include "grab.h"

#include "stamping.h"
#include "touching.h"

#include <string_view>

namespace {

using namespace ps::brushes;
using ps::api::StrokeContext;

constexpr double kForce = 200, kFalloff = 0.2;
constexpr ps::api::ParameterDeclaration kParameters[] = {
    forceOf(kForce, "The most that the hand pulls with: what is heavier, or held fast, stays behind."),
    fallingOff(kFalloff)};

}  // namespace

GrabBrush::GrabBrush()
    : Described({"Grab",
                 "Takes hold of the matter around the hand and carries it across the view until it is let go, at the "
                 "speed that it has by then. What is tied to it comes along. Fixed matter and that of locked bodies "
                 "stays. No step of undo: the timeline goes back to before.",
                 ps::api::listOf(kParameters)}) {}

void GrabBrush::touch(const StrokeContext& context, ps::api::EditKind /*kind*/,
                      const ps::api::List<ps::api::StrokeSample>& samples, ps::api::TouchSink& sink) const {
  const double force = parameter(context, 0, kForce);
  touchAlong(context, samples, parameter(context, 1, kFalloff), sink,
             [&](const ps::api::StrokeSample& sample, ps::api::Touch& touch) {
               touch.kind = ps::api::TouchKind::Hold;
               touch.force = force * sample.pressure;
             });
}

ps::api::Double3 GrabBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* GrabBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kTouchesMatter ? static_cast<const ps::api::MatterBrush*>(this) : nullptr;
}
