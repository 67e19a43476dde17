// SPDX-License-Identifier: MIT
#include "whisk.h"

#include <string_view>

namespace {

using namespace ps::api;

constexpr double kTurn = 6.283185307179586;  // rad
constexpr double kPower = 300, kSpeed = 3 * kTurn, kForce = 40, kFalloff = 0.5, kHottest = 368.15;

constexpr ParameterDeclaration kParameters[] = {
    {"power", "Power", "P", "W", ParameterKind::Number, Scale::Logarithmic, kPower, 1, 1e5, 0, 1e9, "", 1, 0, "",
     "Brush", "Heat that the whisk gives to all it stirs, in each second of the thermal clock; up to 95 °C.",
     "a kitchen machine 300 W", ""},
    {"speed", "Turns", "ω", "rad/s", ParameterKind::Number, Scale::Logarithmic, kSpeed, 0.1 * kTurn, 20 * kTurn, 0,
     1000, "1/s", 1 / kTurn, 0, "", "Brush", "How fast it turns; Ctrl turns it the other way.",
     "by hand 3 turns a second", ""}};

double parameter(const StrokeContext& context, size_t index, double fallback) {
  return index < context.parameters.size ? context.parameters[index] : fallback;
}

}  // namespace

Whisk::Whisk()
    : Described({"Whisk",
                 "Heats and stirs the matter around the hand for as long as it is held there and the scene runs. Undo "
                 "takes the heat back, not the motion.",
                 listOf(kParameters)}) {}

void Whisk::touch(const StrokeContext& context, EditKind kind, const List<StrokeSample>& samples,
                  TouchSink& sink) const {
  const double speed = (kind == EditKind::Remove ? -1 : 1) * parameter(context, 1, kSpeed);
  for (size_t k = 0; k < samples.count; ++k) {
    const StrokeSample sample = samples.at(k);
    Touch both[2];
    for (Touch& touch : both) {
      touch.centre = sample.position;
      touch.radius = context.radius;
      touch.falloff = kFalloff;
    }
    both[0].kind = TouchKind::Heat;
    both[0].power = parameter(context, 0, kPower) * sample.pressure;
    both[0].limit = kHottest;
    both[1].kind = TouchKind::Push;
    both[1].force = kForce * sample.pressure;
    both[1].spin = {speed * context.up.x, speed * context.up.y, speed * context.up.z};
    sink.submit(listOf(both));
  }
}

Double3 Whisk::extent(const StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* Whisk::extension(const char* name) const noexcept {
  return std::string_view(name) == kTouchesMatter ? static_cast<const MatterBrush*>(this) : nullptr;
}
