// SPDX-License-Identifier: Apache-2.0
#include "heat.h"

#include "stamping.h"
#include "touching.h"

#include <string_view>

namespace {

using namespace ps::brushes;
using ps::api::StrokeContext;

constexpr ps::api::ParameterDeclaration kParameters[] = {
    powerOf(kHeating.power,
            "Heat that all matter within the ball gets together, by its mass, in each second of the thermal clock. "
            "Until it is set, it is divided by the time lapse of heat."),
    touching({"limit", "Up to", "T", "K", "Matter that is as warm as this is heated no further.",
              "water that does not boil 95 °C, molten tin 300 °C"},
             {kHeating.limit, 273.15, 3273.15, 2, 10000}, kCelsius, ps::api::Scale::Linear),
    fallingOff(kHeating.falloff)};

}  // namespace

HeatBrush::HeatBrush()
    : Described({"Heat",
                 "Heats the matter around the hand for as long as it is held there and the scene runs, its surface and "
                 "what lies below alike. Fixed matter is heated too, that of locked bodies is not; Ctrl cools. Undo "
                 "takes from each particle what it got, wherever it is by then.",
                 ps::api::listOf(kParameters)}) {}

void HeatBrush::touch(const StrokeContext& context, ps::api::EditKind kind,
                      const ps::api::List<ps::api::StrokeSample>& samples, ps::api::TouchSink& sink) const {
  const bool cools = kind == ps::api::EditKind::Remove;
  const double limit = cools ? kCooling.limit : parameter(context, 1, kHeating.limit);
  exchangeHeat(context, samples, cools,
               {parameter(context, 0, kHeating.power), limit, parameter(context, 2, kHeating.falloff)}, sink);
}

ps::api::Double3 HeatBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

const void* HeatBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kTouchesMatter ? static_cast<const ps::api::MatterBrush*>(this) : nullptr;
}
