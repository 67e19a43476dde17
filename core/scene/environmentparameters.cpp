// SPDX-License-Identifier: Apache-2.0
#include "core/scene/declare.h"
#include "core/scene/project.h"

namespace ps {
namespace {

using namespace declare;

constexpr api::ParameterDeclaration kEnvironment[] = {
    number({"ambient_pressure", "Air pressure", "p", "Pa"}, {101325, 10, 500000, 1, 1e8},
           {"Air", "Pressure of the air around everything. It sets where matter boils and whether it melts at all.",
            "sea level 101.3, Mount Everest 33.7, pressure cooker 200, freeze drying 0.1 kPa", ""},
           {"kPa", 1e-3, 0}, api::Scale::Logarithmic),
    number({"ambient_temperature", "Air temperature", "Tₐ", "K"}, {293.15, 223.15, 473.15, 1, 10000},
           {"Air", "Temperature of the air, which cools or warms all that it touches.",
            "freezer −18 °C, room 20 °C, oven 220 °C", ""},
           kCelsius),
    number(
        {"air_convection", "Air cooling", "h", "W/(m²·K)"}, {5, 0, 50, 0, 1e5},
        {"Air",
         "How fast still air takes heat from everything that it touches: heat per surface, time and degree. Wind from "
         "2 m/s on takes more, as chilled fingers know; with 0 no air takes heat, however it blows.",
         "still air 5 to 10, breeze 25 W/(m²·K), 0 for none",
         "Incropera et al., Fundamentals of Heat and Mass Transfer, ch. 1; Siple & Passel 1945"}),
    number({"air_heat_capacity", "Heat capacity of the air", "C", "J/K"}, {0, 0, 1e4, 0, 1e12},
           {"Air",
            "For a closed box: its air as one lump that grows warmer by the heat it takes. 0 for so much air that it "
            "keeps its temperature. Less than 1e-6, the air of a cubic millimetre, acts as that.",
            "1200 J/K for each cubic metre", ""}),
    number({"wind_speed", "Wind", "u", "m/s"}, {0, 0, 10, 0, 340},
           {"Air",
            "Speed of the air. It carries vapour along, drops and solids too where they have an air drag, and cools "
            "faster.",
            "draught 0.3, breeze 3, hair dryer 10 m/s", ""}),
    actingWhen("wind_speed > 0", number({"wind_direction", "Wind blows towards", "", "°"}, {0, 0, 360, -3600, 3600},
                                        {"Air", "Heading of the wind, level with the ground: 0 along x, 90 along z.",
                                         "180°: against x", ""})),
    number({"air_drag", "Air drag of drops and solids", "C_d", ""}, {0, 0, 1.2, 0, 10},
           {"Air",
            "Drag coefficient of single particles of liquids and solids in air, and with it the air's small lift. 0 is "
            "a vacuum to them. Vapour has a drag of its own.",
            "sphere 0.47, cube 1.05, 0 for none", "Hoerner 1965, Fluid-Dynamic Drag"}),
    actingWhen(
        "scene/thermal_model != none",
        toggle({"radiation", "Heat radiation", "", ""}, false,
               {"Radiation",
                "Whether hot surfaces radiate heat at what they see: other matter, walls that have a "
                "temperature, and what surrounds the scene. It is what cools glowing matter. Gaps narrower than half a "
                "particle spacing count as closed, and up to one spacing matter conducts across them as well.",
                "on for lava, molten metal and candles; hardly matters below 100 °C",
                "Incropera et al., Fundamentals of Heat and Mass Transfer, ch. 12 and 13"})),
    actingWhen("radiation = on",
               number({"surroundings_temperature", "Temperature around", "T_s", "K"}, {293.15, 3, 1273.15, 0, 10000},
                      {"Radiation", "Temperature of what the scene is seen to stand in, for heat radiation.",
                       "room 20 °C, furnace 1200 °C, clear night sky −40 °C, space −270 °C", ""},
                      kCelsius)),
    actingWhen(
        "scene/thermal_model != none",
        number(
            {"contact_conductance", "Contact between bodies", "h_c", "W/(m²·K)"}, {0, 0, 10000, 0, 1e9},
            {"Contact",
             "How well heat passes from one body to another where at least one is solid: rough surfaces touch at few "
             "points. 0 for perfect contact.",
             "iron on iron 2000 to 20000, with grease 50000, loose 500 W/(m²·K)",
             "Incropera et al., Fundamentals of Heat and Mass Transfer, ch. 3"})),
};

}  // namespace

api::ParameterList environmentParameters() { return api::listOf(kEnvironment); }

}  // namespace ps
