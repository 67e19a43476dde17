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
};

}  // namespace

api::ParameterList environmentParameters() { return api::listOf(kEnvironment); }

}  // namespace ps
