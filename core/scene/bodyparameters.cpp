// SPDX-License-Identifier: Apache-2.0
#include "core/scene/declare.h"
#include "core/scene/project.h"

namespace ps {
namespace {

using namespace declare;

constexpr api::ParameterDeclaration kBody[] = {
    atReset(number({"temperature", "Temperature at the start", "T₀", "K"}, {293.15, 173.15, 773.15, 1, 10000},
                   {"Start", "Temperature of the whole body when the scene begins.",
                    "ice from a freezer −18 °C, room 20 °C, boiling water 100 °C", ""},
                   kCelsius)),
    atReset(choice(
        {"phase", "Phase at the start", "", ""}, "automatic|solid|liquid|gas", 0,
        {"Start",
         "Phase when the scene begins; automatic takes the one that is stable at the temperature. Another one brings "
         "its own heat along and turns at once: water of −10 °C begins as slush, of 90 °C at half the pressure it "
         "boils.",
         "at exactly 0 °C: solid for ice, liquid for water", ""})),
    atReset(toggle(
        {"fixed", "Held in place", "", ""}, false,
        {"Start", "Nothing moves it: it stands, or goes on and turns as its velocity and spin say. Heat still flows.",
         "a pan, a mould, a rock in a stream, a paddle", ""})),
    actingWhen(
        "fixed = off",
        toggle(
            {"held", "Held until let go", "", ""}, false,
            {"Start",
             "Matter stands still where it is, in the air too, and others meet it as it stands; heat flows, and it "
             "melts and boils. Let go, it sets off from rest, wherever it is by then; a velocity at the start is lost.",
             "what is sketched in the air until all of it is there; with keys a drop that falls at 2 s", ""})),
    atReset(number(
        {"jitter", "Disorder", "", ""}, {0, 0, 0.3, 0, 0.5},
        {"Start",
         "How far each particle stands off its place in the lattice at the start, along each axis, as a share of "
         "the spacing.",
         "0 for a crystal, 0.2 like a liquid that was shaken", ""})),
    atReset(actingWhen("jitter > 0",
                       integer({"seed", "Seed of the disorder", "", ""}, {1, 1, 100, 0, 4294967295.0},
                               {"Start", "Another number places the particles otherwise; the same number always alike.",
                                "compare runs with 1, 2 and 3 to see what chance does", ""}))),
    actingWhen(
        "scene/thermal_model != none",
        number(
            {"heating_power", "Heating power", "P", "W"}, {0, -500, 2000, -1e9, 1e9},
            {"Heat",
             "Heat that comes up inside the body per second of thermal time, the same in each gram of it; below zero "
             "it is taken away, down to 1 K. What has melted or boiled off goes on being heated.",
             "body warmth 80 W, immersion heater 300 W, kettle 2000 W, −100 W for a fridge", ""})),
    actingWhen(
        "fixed = on & scene/thermal_model != none",
        choice(
            {"heat", "Heat", "", ""}, "conducts|fixed_temperature|adiabatic|convective|fixed_flux", 0,
            {"Heat",
             "Whether a body that is held in place warms and cools as its material does, keeps a temperature "
             "whatever touches it, lets no heat through (then it takes none from the air either, and radiates as "
             "much as it receives), lets through what a fluid behind its surface gives and takes, or gives the same "
             "heat per area of its surface whatever touches it. Like a wall of any shape.",
             "a pan: conducts; a mould that is cooled, a hot plate: fixed temperature; a foam box: adiabatic; a jacket "
             "with cooling water: convective; an electric heater: fixed flux",
             ""})),
    actingWhen("fixed = on & heat = fixed_temperature|convective",
               number({"held_temperature", "Temperature held", "T", "K"}, {293.15, 173.15, 773.15, 1, 10000},
                      {"Heat",
                       "What a body of fixed temperature has, from the start on, or the fluid behind a convective one. "
                       "It gives and takes as much heat as that takes; what conducts well has it up to its surface.",
                       "freezer −18 °C, tap water 10 °C, hot plate 150 °C", ""},
                      kCelsius)),
    actingWhen("fixed = on & heat = convective",
               number({"convection", "Convection behind it", "h", "W/(m²·K)"}, {100, 0, 2000, 0, 1e6},
                      {"Heat",
                       "How fast the fluid behind a convective body's surface gives and takes heat. The body's own "
                       "material conducts nothing then; it is as warm as that fluid.",
                       "air 5 to 25, water at rest 100 to 1000, stirred 2000 to 10000 W/(m²·K)",
                       "Incropera et al., Fundamentals of Heat and Mass Transfer, ch. 1"})),
    actingWhen("fixed = on & heat = fixed_flux",
               number({"heat_flux", "Heat flux", "q", "W/m²"}, {0, -60000, 60000, -1e9, 1e9},
                      {"Heat",
                       "Heat that a body of fixed flux gives to each square metre of matter that touches its surface; "
                       "below zero it takes. A surface one particle thick gives that once, whichever side is touched.",
                       "sunshine 1000, hob 20000 to 60000 W/m²", ""})),
    leastMeans("found",
               number({"surface_area", "Surface in air", "A", "m²"}, {0, 0, 0.1, 0, 1e6},
                      {"Heat",
                       "Surface of the whole body that air and radiation reach, shared among the particles that are "
                       "found outside. 0: as these particles show it, to some 10 %.",
                       "0 for all but experiments with a known surface", ""})),
    actingWhen(
        "fixed = on",
        number(
            {"motion_start", "Sets off at", "", "s"}, {0, 0, 60, 0, 1e9},
            {"Motion",
             "When a body that is held in place, and has a velocity or a spin, begins to move. Until then it stands.",
             "2 lets the water come to rest before the paddle turns", ""})),
    related("should be > motion_start when fixed = on & motion_stop > 0",
            actingWhen(
                "fixed = on",
                leastMeans(
                    "never",
                    number({"motion_stop", "Stops at", "", "s"}, {0, 0, 60, 0, 1e9},
                           {"Motion", "When a body that is held in place, and moves, stands still again; 0 for never.",
                            "10 for a stirrer that is switched off", ""})))),
};

}  // namespace

api::ParameterList bodyParameters() { return api::listOf(kBody); }

api::ParameterDeclaration structureParameter(const std::vector<std::string>& plugins) {
  std::string choices;
  for (const std::string& id : plugins) choices += id + "|";
  choices += kNoStructure;
  return atReset(choice({kStructureKey, "Held together by", "", ""}, kept(choices), static_cast<int>(plugins.size()),
                        {"Structure", "What keeps the body's solid matter in one piece.",
                         "none for sand and liquids, bonds for ice that melts and breaks, rigid for a stone", ""}));
}

}  // namespace ps
