// SPDX-License-Identifier: Apache-2.0
#include "core/scene/declare.h"
#include "core/scene/project.h"

namespace ps {
namespace {

using namespace declare;

constexpr api::ParameterDeclaration kWall[] = {
    choice({"heat", "Heat", "", ""}, "adiabatic|fixed_temperature", 0,
           {"Heat", "Whether the wall lets no heat through or is held at a temperature whatever touches it.",
            "a foam box is adiabatic, a hot plate has a fixed temperature", ""}),
    number({"temperature", "Temperature", "T", "K"}, {293.15, 173.15, 773.15, 1, 10000},
           {"Heat", "Temperature of the wall's surface, where heat is set to a fixed temperature.",
            "freezer −18 °C, tap water 10 °C, hot plate 150 °C", ""},
           kCelsius),
    number({"film_coefficient", "Condensation", "h", "W/(m²·K)"}, {500, 0, 5000, 0, 1e6},
           {"Heat", "How fast vapour gives its heat to this wall where the wall is below the boiling point.",
            "thin water film 1000 to 5000, with air in the steam 100 to 500, 0 for none",
            "Nusselt 1916; Incropera et al., Fundamentals of Heat and Mass Transfer, ch. 10"}),
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

}  // namespace ps
