// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/brushsettings.h"

#include "core/scene/declare.h"
#include "ui/theme/numbers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {
using namespace declare;

constexpr const char* kGuides = "Guides";
constexpr const char* kThrough = "Where the mirror stands and the axis of turned copies goes through.";
constexpr const char* kMiddle = "0 the middle of most scenes";

constexpr api::ParameterDeclaration place(Names names, const char* help, const char* example) {
  return number(names, {0, -1, 1, -1000, 1000}, {kGuides, help, example, ""}, kMillimetres);
}

constexpr api::ParameterDeclaration kBrush[] = {
    number({"radius", "Radius", "r", "m"}, {0.05, kBrushMinimum, 0.3, kBrushMinimum, kBrushMaximum},
           {"Brush", "Half the brush's width; the outline under the pointer shows it true to scale.",
            "a finger 10 mm, a fist 50 mm", ""},
           kMillimetres, api::Scale::Logarithmic),
    number({"temperature", "Temperature", "T", "K"}, {293.15, 173.15, 773.15, 1, 10000},
           {"New matter",
            "Temperature of what is drawn; below its melting point it is drawn as a solid that holds together.",
            "ice from a freezer −18 °C, room 20 °C, hot oil 180 °C", ""},
           kCelsius),
    choice(
        {"becomes", "Becomes", "", ""}, kBecomings, 0,
        {"New matter",
         "What bodies that are begun become. As the material is: stiff solids that are far from melting stand as rigid "
         "bodies, other solids are bonded, and the rest flows. The body's row Held together by changes it later.",
         "rigid for a wooden cup, soft for a cushion, fixed for the ground", ""}),
    toggle({"held", "Held until let go", "", ""}, false,
           {"New matter",
            "Bodies that are begun stand still as they are drawn, in the air too, until Sketch > Make it real (Enter) "
            "lets all of them go at once. Matter that is there goes on living.",
            "a cup and what it is to hold, before either falls", ""}),
    choice({"draw_on", "Draw on", "", ""}, "surface|level|across_x|across_z|view", 0,
           {kGuides, "What strokes lie on: what is under the pointer, or a plane in the air, which a grid shows.",
            "a level plane for the rim of a bowl", ""}),
    actingWhen("draw_on = level|across_x|across_z",
               place({"plane_at", "Plane at", "", "m"},
                     "Height of the level plane, or place of the upright one along its axis.", "a table top 700 mm")),
    number({"steady", "Steady hand", "", "m"}, {0, 0, 0.1, 0, 1},
           {kGuides, "How far the brush trails behind the pointer: it smooths what a hand does on the way.",
            "0 draws where the pointer is, 20 mm smooth curves", ""},
           kMillimetres),
    choice({"mirror", "Mirror", "", ""}, "none|x|y|z", 0,
           {kGuides, "Draws the mirror image along with each stroke.", "x for a vase that is seen from the front", ""}),
    integer({"turns", "Turned copies", "", ""}, {1, 1, 12, 1, kMostTurns},
            {kGuides, "Draws so many copies about an upright axis, each stroke itself among them.",
             "4 the legs of a table, 12 the petals of a flower", ""}),
    place({"centre_x", "Centre, x", "", "m"}, kThrough, kMiddle),
    actingWhen("mirror = y", place({"centre_y", "Centre, y", "", "m"}, "Height of a level mirror.", kMiddle)),
    place({"centre_z", "Centre, z", "", "m"}, kThrough, kMiddle),
};

}  // namespace

api::ParameterList brushParameters() { return api::listOf(kBrush); }

ParameterSet valuesOf(const BrushSettings& brush) {
  ParameterSet set;
  set.values = {{"radius", brush.radius},
                {"temperature", brush.temperature},
                {"becomes", brush.becomes},
                {"held", brush.held},
                {"draw_on", std::string(kDrawOnNames.at(static_cast<size_t>(brush.drawOn)))},
                {"plane_at", brush.planeAt},
                {"steady", brush.steady},
                {"mirror", brush.symmetry.mirror},
                {"turns", static_cast<double>(brush.symmetry.turns)},
                {"centre_x", brush.symmetry.centre.x()},
                {"centre_y", brush.symmetry.centre.y()},
                {"centre_z", brush.symmetry.centre.z()}};
  return set;
}

void setValueOf(BrushSettings& brush, const std::string& key, const Value& value) {
  if (key == "draw_on") {
    const auto found = std::find(kDrawOnNames.begin(), kDrawOnNames.end(), std::get<std::string>(value));
    if (found != kDrawOnNames.end()) brush.drawOn = static_cast<DrawOn>(found - kDrawOnNames.begin());
  } else if (key == "becomes") {
    brush.becomes = std::get<std::string>(value);
  } else if (key == "held") {
    brush.held = std::get<bool>(value);
  } else if (key == "mirror") {
    brush.symmetry.mirror = std::get<std::string>(value);
  } else if (key == "turns") {
    brush.symmetry.turns = static_cast<int>(std::lround(std::get<double>(value)));
  }
  const std::pair<const char*, double*> numbers[] = {{"radius", &brush.radius},
                                                     {"temperature", &brush.temperature},
                                                     {"plane_at", &brush.planeAt},
                                                     {"steady", &brush.steady},
                                                     {"centre_x", &brush.symmetry.centre.x()},
                                                     {"centre_y", &brush.symmetry.centre.y()},
                                                     {"centre_z", &brush.symmetry.centre.z()}};
  for (const auto& [name, number] : numbers)
    if (key == name) *number = std::get<double>(value);
}

ParameterSet BrushSettings::shapeParameters() const {
  const auto found = parameters.find(shape);
  return found == parameters.end() ? ParameterSet{} : found->second;
}

QString lengthText(double metres) {
  if (std::abs(metres) < 1) return formatQuantity(metres * 1000, QStringLiteral("mm"), 3);
  return formatQuantity(metres, QStringLiteral("m"), 3);
}

}  // namespace ps
