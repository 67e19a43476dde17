// SPDX-License-Identifier: Apache-2.0
#include "core/parameters/condition.h"
#include "core/scene/declare.h"
#include "core/scene/scenewall.h"

namespace ps {
namespace {

using namespace declare;

constexpr api::ParameterDeclaration kWall[] = {
    choice(
        {"shape", "Shape", "", ""}, "plane|cylinder|sphere", 0,
        {"Shape",
         "An endless plane, an endless cylinder that planes close at its ends, or a whole sphere. Curved walls should "
         "be four particle spacings in radius or more.",
         "floor and sides: plane; pipe, glass, pillar: cylinder; bowl, flask, ball: sphere", ""}),
    actingWhen("shape = cylinder|sphere", choice({"matter", "Matter is", "", ""}, "inside|outside", 0,
                                                 {"Shape", "On which side of a curved wall matter can be.",
                                                  "pipe and bowl: inside; pillar and ball: outside", ""})),
    actingWhen("shape = cylinder|sphere",
               number({"radius", "Radius", "R", "m"}, {0.25, 0.01, 2, 1e-6, 1e4},
                      {"Shape", "Of a cylinder or a sphere, up to its face.", "garden hose 6 mm, bucket 150 mm", ""})),
    actingWhen(
        "scene/thermal_model != none",
        choice(
            {"heat", "Heat", "", ""}, "adiabatic|fixed_temperature|fixed_flux|convective", 0,
            {"Heat",
             "Whether the wall lets no heat through, is held at a temperature whatever touches it, gives the same heat "
             "per area whatever its temperature, or lets through what a fluid behind it gives and takes.",
             "foam box: adiabatic; hot plate: fixed temperature; electric heater: fixed flux; cooling water behind a "
             "jacket: convective",
             ""})),
    actingWhen("heat = fixed_temperature|convective",
               number({"temperature", "Temperature", "T", "K"}, {293.15, 173.15, 773.15, 1, 10000},
                      {"Heat",
                       "Temperature of the wall's surface, where heat is set to a fixed temperature; of the fluid "
                       "behind it, where it is convective.",
                       "freezer −18 °C, tap water 10 °C, hot plate 150 °C", ""},
                      kCelsius)),
    actingWhen(
        "heat = fixed_flux",
        number({"heat_flux", "Heat flux", "q", "W/m²"}, {0, -60000, 60000, -1e9, 1e9},
               {"Heat", "Heat that the wall gives to each square metre of matter that touches it; below zero it takes.",
                "sunshine 1000, hob 20000 to 60000 W/m²", ""})),
    actingWhen("heat = convective",
               number({"convection", "Convection behind it", "h", "W/(m²·K)"}, {100, 0, 2000, 0, 1e6},
                      {"Heat", "How fast the fluid behind a convective wall gives and takes heat.",
                       "air 5 to 25, water at rest 100 to 1000, stirred 2000 to 10000 W/(m²·K)",
                       "Incropera et al., Fundamentals of Heat and Mass Transfer, ch. 1"})),
    actingWhen("heat = fixed_temperature|convective & environment/radiation = on",
               number({"emissivity", "Emissivity", "ε", ""}, {0.9, 0, 1, 0, 1},
                      {"Heat",
                       "How well a wall that has a temperature radiates and absorbs, where the scene's heat is "
                       "radiated. Other walls send back what they receive.",
                       "polished metal 0.05, brick, paint and enamel 0.9", "Incropera et al., app. A.11"})),
    actingWhen("heat = fixed_temperature",
               number({"film_coefficient", "Condensation", "h", "W/(m²·K)"}, {500, 0, 5000, 0, 1e6},
                      {"Heat", "How fast vapour gives its heat to this wall where the wall is below the boiling point.",
                       "thin water film 1000 to 5000, with air in the steam 100 to 500 W/(m²·K), 0 for none",
                       "Nusselt 1916; Incropera et al., Fundamentals of Heat and Mass Transfer, ch. 10"})),
    number({"friction", "Friction", "µ", ""}, {0.3, 0, 1, 0, 10},
           {"Contact", "How strongly solids stick and drag on the wall: sideways force per pressing force.",
            "ice on steel 0.03, wood on wood 0.4, rubber on asphalt 0.9", ""}),
    toggle(
        {"no_slip", "Thick liquids stick", "", ""}, true,
        {"Contact",
         "Whether liquids of the implicit viscosity solver cling to the wall, as real ones do. Off, they slide along "
         "it without resistance, as along a plane of symmetry.",
         "on: honey on a plate; off: honey on an oiled plate", "Weiler et al. 2018"}),
};

}  // namespace

api::ParameterList wallParameters() { return api::listOf(kWall); }

WallFace faceOf(const SceneWall& wall) {
  const api::ParameterList list = wallParameters();
  const Vector3 normal = wall.normal.normalized();
  // Brushes ask for each cell: most walls are planes that say nothing of it.
  const bool says = wall.parameters.values.contains("shape");
  const std::string shape = says ? choiceOf(wall.parameters, list, "shape") : std::string();
  if (!says || shape == shapeOf(WallForm::Plane)) return WallFace(Plane{normal, normal.dot(wall.point)});
  const double radius = numberOf(wall.parameters, list, "radius");
  const bool inside = choiceOf(wall.parameters, list, "matter") == "inside";
  return shape == shapeOf(WallForm::Sphere) ? WallFace::sphere(wall.point, radius, inside)
                                            : WallFace::cylinder(wall.point, normal, radius, inside);
}

const std::string& shapeOf(WallForm form) {
  static const std::vector<std::string> kShapes = choicesOf(*findDeclaration(wallParameters(), "shape"));
  return kShapes[static_cast<size_t>(form)];
}

bool hasTemperature(const SceneWall& wall) {
  const api::ParameterList list = wallParameters();
  return holds(parseCondition(findDeclaration(list, "temperature")->enabledWhen),
               [&](std::string_view key) -> std::optional<Value> {
                 const api::ParameterDeclaration* declaration = findDeclaration(list, key);
                 return declaration ? std::optional(valueOf(wall.parameters, *declaration)) : std::nullopt;
               });
}

}  // namespace ps
