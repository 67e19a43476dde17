// SPDX-License-Identifier: Apache-2.0
#include "stir.h"

#include "stamping.h"
#include "touching.h"

#include "vectors.h"
#include <string_view>

namespace {

using namespace ps::brushes;
using ps::api::StrokeContext;

constexpr double kTurn = 2 * 3.14159265358979323846;  // rad
constexpr double kForce = 50, kSpeed = 2 * kTurn, kFalloff = 0.5;
constexpr ps::api::ParameterDeclaration kParameters[] = {
    forceOf(kForce, "The most that the hand stirs with, all matter within the ball together."),
    touching({"speed", "Turns", "ω", "rad/s", "How fast matter is to go round; Ctrl goes the other way.",
              "a spoon 2, a whisk 10 turns a second"},
             {kSpeed, 0.1 * kTurn, 20 * kTurn, 0, 1000}, {"1/s", 1 / kTurn, 0}),
    fallingOff(kFalloff)};

}  // namespace

StirBrush::StirBrush()
    : Described(
          {"Stir",
           "Turns the matter around the hand about the direction away from what it points at, for as long as it is "
           "held there and the scene runs. Fixed matter and that of locked bodies stays. No step of undo: the "
           "timeline goes back to before.",
           ps::api::listOf(kParameters)}) {}

void StirBrush::touch(const StrokeContext& context, ps::api::EditKind kind,
                      const ps::api::List<ps::api::StrokeSample>& samples, ps::api::TouchSink& sink) const {
  const double force = parameter(context, 0, kForce);
  const double speed = (kind == ps::api::EditKind::Remove ? -1 : 1) * parameter(context, 1, kSpeed);
  touchAlong(context, samples, parameter(context, 2, kFalloff), sink,
             [&](const ps::api::StrokeSample& sample, ps::api::Touch& touch) {
               touch.kind = ps::api::TouchKind::Push;
               touch.force = force * sample.pressure;
               touch.spin = scaled(context.up, speed);
             });
}

ps::api::Double3 StirBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* StirBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kTouchesMatter ? static_cast<const ps::api::MatterBrush*>(this) : nullptr;
}
