// SPDX-License-Identifier: Apache-2.0
#include "core/scene/declare.h"
#include "core/scene/project.h"

namespace ps {
namespace {

using namespace declare;

constexpr api::ParameterDeclaration kEnvironment[] = {
    number({"ambient_pressure", "Air pressure", "p", "Pa"}, {101325, 1000, 500000, 1, 1e8},
           {"Air", "Pressure of the air around everything. It sets where matter boils and whether it melts at all.",
            "sea level 101.3 kPa, Mount Everest 33.7, pressure cooker 200", ""},
           {"kPa", 1e-3, 0}, api::Scale::Logarithmic),
    number({"ambient_temperature", "Air temperature", "Tₐ", "K"}, {293.15, 223.15, 473.15, 1, 10000},
           {"Air", "Temperature of the air, which cools or warms vapour that flies through it.",
            "freezer −18 °C, room 20 °C, oven 220 °C", ""},
           kCelsius),
    number({"air_convection", "Air cooling", "h", "W/(m²·K)"}, {5, 0, 50, 0, 1e5},
           {"Air", "How fast air takes heat from vapour in the open: heat per surface, time and degree.",
            "still air 5 to 10, breeze 25, 0 for none",
            "Incropera et al., Fundamentals of Heat and Mass Transfer, ch. 1"}),
    number({"wind_speed", "Wind", "u", "m/s"}, {0, 0, 10, 0, 340},
           {"Air", "Speed of the air. It carries vapour along, and drops and solids too where they have an air drag.",
            "draught 0.3, breeze 3, hair dryer 10", ""}),
    number({"wind_direction", "Wind blows towards", "", "°"}, {0, 0, 360, -3600, 3600},
           {"Air", "Heading of the wind, level with the ground: 0 along x, 90 along z.", "180: against x", ""}),
    number({"air_drag", "Air drag of drops and solids", "C_d", ""}, {0, 0, 1.2, 0, 10},
           {"Air",
            "Drag coefficient of single particles of liquids and solids in air, and with it the air's small lift. 0 is "
            "a vacuum to them. Vapour has a drag of its own.",
            "sphere 0.47, cube 1.05, 0 for none", "Hoerner 1965, Fluid-Dynamic Drag"}),
};

}  // namespace

api::ParameterList environmentParameters() { return api::listOf(kEnvironment); }

}  // namespace ps
