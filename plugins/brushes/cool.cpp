// SPDX-License-Identifier: Apache-2.0
#include "cool.h"

#include "stamping.h"
#include "touching.h"

#include <string_view>

namespace {

using namespace ps::brushes;
using ps::api::StrokeContext;

constexpr ps::api::ParameterDeclaration kParameters[] = {
    powerOf(kCooling.power,
            "Heat that is taken from all matter within the ball together, by its mass, in each second of the thermal "
            "clock. Until it is set, it is divided by the time lapse of heat."),
    touching({"limit", "Down to", "T", "K", "Matter that is as cold as this is cooled no further.",
              "a freezer −18 °C, dry ice −78 °C, liquid nitrogen −196 °C"},
             {kCooling.limit, 73.15, 373.15, 1, 10000}, kCelsius, ps::api::Scale::Linear),
    fallingOff(kCooling.falloff)};

}  // namespace

CoolBrush::CoolBrush()
    : Described({"Cool",
                 "Cools the matter around the hand for as long as it is held there and the scene runs, its surface and "
                 "what lies below alike. Fixed matter is cooled too, that of locked bodies is not; Ctrl heats. Undo "
                 "gives each particle back what was taken, wherever it is by then.",
                 ps::api::listOf(kParameters)}) {}

void CoolBrush::touch(const StrokeContext& context, ps::api::EditKind kind,
                      const ps::api::List<ps::api::StrokeSample>& samples, ps::api::TouchSink& sink) const {
  const bool heats = kind == ps::api::EditKind::Remove;
  const double limit = heats ? kHeating.limit : parameter(context, 1, kCooling.limit);
  exchangeHeat(context, samples, !heats,
               {parameter(context, 0, kCooling.power), limit, parameter(context, 2, kCooling.falloff)}, sink);
}

ps::api::Double3 CoolBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* CoolBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kTouchesMatter ? static_cast<const ps::api::MatterBrush*>(this) : nullptr;
}
