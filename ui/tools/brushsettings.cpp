// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/brushsettings.h"

#include "core/scene/declare.h"
#include "ui/theme/numbers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ps {
namespace {
using namespace declare;

constexpr const char* kGuides = "Guides";
constexpr const char* kThrough = "Where the mirror stands and the axis of turned copies goes through.";
constexpr const char* kMiddle = "0 the middle of most scenes";

constexpr const char* kOnPlane = "draw_on = plane";
constexpr const char* kPlanePoint = "A place that the plane goes through; its grid has its middle there.";
constexpr double kHalfTurn = std::numbers::pi;
constexpr Display kDegrees{"°", 180 / std::numbers::pi, 0};

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
    toggle({"joins", "Goes on with other matter", "", ""}, false,
           {"New matter",
            "A stroke that begins on a sketched body goes on with it whatever the body is made of so far: it then is "
            "of several materials, or temperatures. Without it such a stroke begins a body of its own.",
            "a wooden handle on an iron head, one tool", ""}),
    toggle({"held", "Held until let go", "", ""}, false,
           {"New matter",
            "Bodies that are begun stand still as they are drawn, in the air too, until Sketch > Make it real (Enter) "
            "lets all of them go at once. Matter that is there goes on living.",
            "a cup and what it is to hold, before either falls", ""}),
    choice({"draw_on", "Draw on", "", ""}, "surface|level|across_x|across_z|view|plane", 0,
           {kGuides,
            "What strokes lie on: what is under the pointer, or a plane in the air, which a grid shows. Sketch > Plane "
            "from the surface lays one on what the pointer is on, Plane across the view one that faces you.",
            "a level plane for the rim of a bowl, a tilted one for the wall of a funnel", ""}),
    actingWhen("draw_on = level|across_x|across_z",
               place({"plane_at", "Plane at", "", "m"},
                     "Height of the level plane, or place of the upright one along its axis.", "a table top 700 mm")),
    actingWhen(kOnPlane, place({"plane_x", "Plane through, x", "", "m"}, kPlanePoint, kMiddle)),
    actingWhen(kOnPlane, place({"plane_y", "Plane through, y", "", "m"}, kPlanePoint, "a table top 700 mm")),
    actingWhen(kOnPlane, place({"plane_z", "Plane through, z", "", "m"}, kPlanePoint, kMiddle)),
    actingWhen(kOnPlane,
               number({"plane_tilt", "Plane tilted by", "", "rad"}, {0, 0, kHalfTurn, 0, kHalfTurn},
                      {kGuides, "How far the plane leans from level.", "a roof 35°, a wall 90°", ""}, kDegrees)),
    actingWhen("draw_on = plane & plane_tilt > 0",
               number({"plane_heading", "Tilted towards", "", "rad"}, {0, -kHalfTurn, kHalfTurn, -kHalfTurn, kHalfTurn},
                      {kGuides, "Where the plane leans to: 0° the front, 90° the right, 180° the back.",
                       "0° a desk that slopes to its writer", ""},
                      kDegrees)),
    number({"grid", "Grid", "", "m"}, {0, 0, 0.2, 0, 1000},
           {kGuides, "How far apart the lines of a drawing plane's grid are; 0 as far as suits the scene.",
            "squared paper 5 mm", ""},
           kMillimetres),
    choice({"snap_to", "Snap to", "", ""}, "none|grid|strokes|ends", 0,
           {kGuides,
            "What strokes snap to, where they begin and on their way: the crossings of the grid, the ways of earlier "
            "strokes as the document has them, or their ends alone. Not while Shift is held.",
            "ends, to close the rim of a bowl", ""}),
    actingWhen(
        "snap_to = strokes|ends",
        number({"snap_within", "Snaps within", "", "m"}, {0.03, 0.001, 0.2, 1e-4, 10},
               {kGuides, "How near to a stroke the pointer has to come, as one sees it.", "a finger's width 15 mm", ""},
               kMillimetres)),
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

/// One of an enumeration by its name; another one changes nothing.
template <class Names, class Enumeration>
void choose(const Names& names, const Value& value, Enumeration& chosen) {
  const auto found = std::find(names.begin(), names.end(), std::get<std::string>(value));
  if (found != names.end()) chosen = static_cast<Enumeration>(found - names.begin());
}

}  // namespace

Vector3 FreePlane::normal() const {
  return {std::sin(tilt) * std::sin(heading), std::cos(tilt), std::sin(tilt) * std::cos(heading)};
}

FreePlane FreePlane::across(const Vector3& point, const Vector3& normal) {
  const double level = std::hypot(normal.x(), normal.z());
  return {point, std::atan2(level, normal.y()), level > 0 ? std::atan2(normal.x(), normal.z()) : 0};
}

api::ParameterList brushParameters() { return api::listOf(kBrush); }

ParameterSet valuesOf(const BrushSettings& brush) {
  ParameterSet set;
  set.values = {{"radius", brush.radius},
                {"temperature", brush.temperature},
                {"becomes", brush.becomes},
                {"joins", brush.joins},
                {"held", brush.held},
                {"draw_on", std::string(kDrawOnNames.at(static_cast<size_t>(brush.drawOn)))},
                {"plane_at", brush.planeAt},
                {"plane_x", brush.plane.point.x()},
                {"plane_y", brush.plane.point.y()},
                {"plane_z", brush.plane.point.z()},
                {"plane_tilt", brush.plane.tilt},
                {"plane_heading", brush.plane.heading},
                {"grid", brush.grid},
                {"snap_to", std::string(kSnapToNames.at(static_cast<size_t>(brush.snapTo)))},
                {"snap_within", brush.snapWithin},
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
    choose(kDrawOnNames, value, brush.drawOn);
  } else if (key == "snap_to") {
    choose(kSnapToNames, value, brush.snapTo);
  } else if (key == "becomes") {
    brush.becomes = std::get<std::string>(value);
  } else if (key == "held") {
    brush.held = std::get<bool>(value);
  } else if (key == "joins") {
    brush.joins = std::get<bool>(value);
  } else if (key == "mirror") {
    brush.symmetry.mirror = std::get<std::string>(value);
  } else if (key == "turns") {
    brush.symmetry.turns = static_cast<int>(std::lround(std::get<double>(value)));
  }
  const std::pair<const char*, double*> numbers[] = {{"radius", &brush.radius},
                                                     {"temperature", &brush.temperature},
                                                     {"plane_at", &brush.planeAt},
                                                     {"plane_x", &brush.plane.point.x()},
                                                     {"plane_y", &brush.plane.point.y()},
                                                     {"plane_z", &brush.plane.point.z()},
                                                     {"plane_tilt", &brush.plane.tilt},
                                                     {"plane_heading", &brush.plane.heading},
                                                     {"grid", &brush.grid},
                                                     {"snap_within", &brush.snapWithin},
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
