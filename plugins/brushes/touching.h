// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/brush.h>

namespace ps::brushes {

/// Numbers that people see: shown = stored * scale + offset.
struct Shown {
  const char* unit = "";
  double scale = 1, offset = 0;
};
/// Default, the slider's range, and the range beyond which values are refused.
struct Range {
  double value, minimum, maximum, hardMinimum, hardMaximum;
};
struct Words {
  const char *key, *label, *symbol, *unit, *help, *example;
};
/// A declaration of what a hand does to matter.
constexpr api::ParameterDeclaration touching(const Words& w, const Range& r, const Shown& shown = {},
                                             api::Scale scale = api::Scale::Logarithmic) {
  return {w.key,
          w.label,
          w.symbol,
          w.unit,
          api::ParameterKind::Number,
          scale,
          r.value,
          r.minimum,
          r.maximum,
          r.hardMinimum,
          r.hardMaximum,
          shown.unit,
          shown.scale,
          shown.offset,
          "",
          "Brush",
          w.help,
          w.example,
          ""};
}
constexpr api::ParameterDeclaration powerOf(double value, const char* help) {
  return touching({"power", "Power", "P", "W", help, "a hair dryer 1500 W, a candle 80 W; times the speed of heat"},
                  {value, 1, 1e6, 0.001, 1e12});
}
constexpr api::ParameterDeclaration forceOf(double value, const char* help) {
  return touching({"force", "Force", "F", "N", help, "1 kg weighs 10 N; a hand that pulls hard 500 N"},
                  {value, 1, 1e4, 0.001, 1e9});
}
constexpr api::ParameterDeclaration fallingOff(double value) {
  return touching({"falloff", "Falloff", "", "", "How far from the rim inwards the brush fades to nothing.",
                   "0 % as strong everywhere, 100 % strongest in the middle"},
                  {value, 0, 1, 0, 1}, {"%", 100, 0}, api::Scale::Linear);
}
constexpr Shown kCelsius{"°C", 1, -273.15};

/// A ball around each sample, pressed as hard as the pen is, with what `each` makes of it; those of no force and no
/// power are left out.
template <class Each>
void touchAlong(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, double falloff,
                api::TouchSink& sink, const Each& each) {
  for (size_t k = 0; k < samples.count; ++k) {
    const api::StrokeSample sample = samples.at(k);
    api::Touch touch;
    touch.centre = sample.position;
    touch.radius = context.radius;
    touch.falloff = falloff;
    each(sample, touch);
    if (touch.force == 0 && touch.power == 0) continue;
    sink.submit({&touch, 1, sizeof touch});
  }
}

/// What the brushes for heat have as parameters, in this order.
struct HeatValues {
  double power, limit, falloff;  ///< W, K, and a share
};
/// Where heat is as fast as it really is, a hand is to do something that one sees within 2 s. A ball of 5 cm at the
/// face of ice reaches 0.24 kg of it, which count as 0.1 kg with that falloff: of 20 kJ, from −10 °C, its middle takes
/// 21 kJ/kg to begin to melt, after 0.2 s, and half of the latent heat of 334 kJ/kg within the 2 s.
inline constexpr double kVisiblePower = 10000;
inline constexpr HeatValues kHeating{kVisiblePower, 1273.15, 0.5}, kCooling{kVisiblePower, 195.15, 0.5};
/// Gives heat as far as the limit, or takes it where `cools`. The opposite of a brush goes as far as the other one
/// does.
void exchangeHeat(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, bool cools,
                  const HeatValues& values, api::TouchSink& sink);

/// Cuts along the way by a blade as wide as the ball, which goes with the hand and is seen from its edge: a hand that
/// stays cuts nothing. Where nobody looks it stands on what is drawn on. Where `whole`, all of the ball cuts.
void cutAlong(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, bool whole,
              api::TouchSink& sink);
/// Welds what touches within the ball.
void weldAlong(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, api::TouchSink& sink);
inline constexpr api::ParameterDeclaration kWholeBall[] = {
    {"whole", "Whole ball", "", "", api::ParameterKind::Toggle, api::Scale::Linear, 0, 0, 1, 0, 1, "", 1, 0, "",
     "Brush", "Cuts all ties that reach into the ball, so that what is within crumbles, instead of along a blade.",
     "off: a knife, on: a grinder", ""}};

}  // namespace ps::brushes
