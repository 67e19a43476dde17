// SPDX-License-Identifier: Apache-2.0
#include "tint.h"

#include "balls.h"

#include <string_view>

namespace {

using ps::api::ParameterKind;
using ps::api::Scale;

constexpr double kRed = 0.85, kGreen = 0.2, kBlue = 0.25;
enum : size_t { kPressure, kRedOf, kGreenOf, kBlueOf, kBare };

constexpr ps::api::ParameterDeclaration part(const char* key, const char* label, const char* symbol, double value,
                                             const char* help) {
  return ps::api::actingWhen(
      "bare = off", {key, label, symbol, "", ParameterKind::Number, Scale::Linear, value, 0, 1, 0, 1, "%", 100, 0, "",
                     "Brush", help, "a brick 70, 25, 15 %, a leaf 20, 50, 15 %, the sky 45, 65, 90 %", ""});
}

constexpr ps::api::ParameterDeclaration kParameters[] = {
    ps::brushes::kBallParameters[0],
    part("red", "Red", "R", kRed, "Red part of the colour that matter gets (sRGB)."),
    part("green", "Green", "G", kGreen, "Green part of the colour that matter gets (sRGB)."),
    part("blue", "Blue", "B", kBlue, "Blue part of the colour that matter gets (sRGB)."),
    {"bare", "As its material", "", "", ParameterKind::Toggle, Scale::Linear, 0, 0, 1, 0, 1, "", 1, 0, "", "Brush",
     "Takes colours off again: matter looks like its material.", "off: a paint pot, on: a sponge", ""},
};

}  // namespace

TintBrush::TintBrush()
    : Described({"Paint colour",
                 "Gives the matter within the ball a colour of its own, and changes nothing else of it. It keeps the "
                 "colour wherever it flows, and whatever it becomes. It shows where the view is coloured by matter. "
                 "Matter of locked bodies stays as it is.",
                 ps::api::listOf(kParameters)}) {}

void TintBrush::stroke(const ps::api::StrokeContext& context, ps::api::EditKind kind,
                       const ps::api::List<ps::api::StrokeSample>& samples, ps::api::EditSink& sink) const {
  const auto coloured = kind == ps::api::EditKind::Remove ? kind : ps::api::EditKind::Colour;
  ps::brushes::submitBalls(context, coloured, samples, sink);
}

ps::api::Double3 TintBrush::extent(const ps::api::StrokeContext& context) const noexcept {
  return {context.radius, context.radius, context.radius};
}

ps::api::Double3 TintBrush::colour(const ps::api::StrokeContext& context) const noexcept {
  using ps::brushes::parameter;
  if (parameter(context, kBare, 0) != 0) return {-1, -1, -1};
  return {parameter(context, kRedOf, kRed), parameter(context, kGreenOf, kGreen), parameter(context, kBlueOf, kBlue)};
}

const void* TintBrush::extension(const char* name) const noexcept {
  return std::string_view(name) == ps::api::kColoursMatter ? static_cast<const ps::api::ColourBrush*>(this) : nullptr;
}
