// SPDX-License-Identifier: Apache-2.0
// What people read beside every slider of a material. One entry per property; panels, JSON checks, the documentation
// and the plugins' own checks are made from this list.
#include "core/matter/material.h"

namespace ps {
namespace {

using api::actingWhen;
using api::ParameterDeclaration;
using api::ParameterKind;
using api::related;
using api::Scale;

constexpr ParameterKind kNumber = ParameterKind::Number;
constexpr ParameterKind kResponse = ParameterKind::Response;
constexpr ParameterKind kToggle = ParameterKind::Toggle;
constexpr Scale kLinear = Scale::Linear;
constexpr Scale kLogarithmic = Scale::Logarithmic;
constexpr double kCelsius = -273.15;

// key, label, symbol, unit, kind, scale, default, minimum, maximum, hardMinimum, hardMaximum,
// displayUnit, displayScale, displayOffset, choices, group, help, example, source
constexpr ParameterDeclaration kProperties[] = {
    // Heat
    {"conductivity_solid", "Conductivity, solid", "k_s", "W/(m·K)", kResponse, kLogarithmic, 1, 0.02, 500, 0, 1e4, "",
     1, 0, "", "Heat",
     "How easily heat runs through the solid: at twice the value a block warms through twice as fast.",
     "ice 2.2, wax 0.24, wood 0.15, iron 80, copper 400 W/(m·K)", "CRC Handbook of Chemistry and Physics"},
    {"conductivity_liquid", "Conductivity, liquid", "k_l", "W/(m·K)", kResponse, kLogarithmic, 0.5, 0.02, 100, 0, 1e4,
     "", 1, 0, "", "Heat",
     "How easily heat runs through the liquid at rest; stirring and convection carry more and come by themselves.",
     "water 0.60, molten wax 0.15, ethanol 0.17, liquid iron 36 W/(m·K)", "CRC Handbook of Chemistry and Physics"},
    actingWhen("boiling_temperature > 0",
               {"conductivity_gas", "Conductivity, vapour", "k_g", "W/(m·K)", kResponse, kLogarithmic, 0.025, 0.005, 1,
                0, 1e4, "", 1, 0, "", "Heat",
                "How easily heat runs through the vapour: so poorly that a film of it shields a drop from a hot plate.",
                "steam 0.025, air 0.026, carbon dioxide 0.015 W/(m·K)", "CRC Handbook of Chemistry and Physics"}),
    {"heat_capacity_solid", "Heat capacity, solid", "c_s", "J/(kg·K)", kNumber, kLinear, 2000, 100, 5000, 1, 1e5, "", 1,
     0, "", "Heat", "Heat that warms one kilogram of the solid by one degree.",
     "ice 2100, wax 2100, glass 840, iron 449, lead 129 J/(kg·K)", "CRC Handbook of Chemistry and Physics"},
    {"heat_capacity_liquid", "Heat capacity, liquid", "c_l", "J/(kg·K)", kNumber, kLinear, 2000, 100, 5000, 1, 1e5, "",
     1, 0, "", "Heat",
     "Heat that warms one kilogram of the liquid by one degree; large values make it slow to heat and to cool.",
     "water 4186, ethanol 2440, molten wax 2300, mercury 140 J/(kg·K)", "CRC Handbook of Chemistry and Physics"},
    actingWhen(
        "boiling_temperature > 0",
        {"heat_capacity_gas", "Heat capacity, vapour", "c_g", "J/(kg·K)", kNumber, kLinear, 1500, 100, 5000, 1, 1e5, "",
         1, 0, "", "Heat", "Heat that warms one kilogram of the vapour by one degree at constant pressure.",
         "steam 2010, air 1005, carbon dioxide 846 J/(kg·K)", "NIST Chemistry WebBook"}),

    // Phase change
    related("must be >= solidus when melting_temperature > 0 unless solidus >= liquidus; must be <= liquidus when "
            "melting_temperature > 0 unless solidus >= liquidus",
            {"melting_temperature", "Melting point", "T_m", "K", kNumber, kLinear, 273.15, 50, 2000, 0, 1e4, "°C", 1,
             kCelsius, "", "Phase change",
             "Where solid and liquid are in balance at 1 atm; heat then melts the matter without warming it. None: it "
             "never melts, it only grows thin, as glass and honey do.",
             "water 0, gallium 29.8, candle wax 58, lead 327, iron 1538 °C", "CRC Handbook of Chemistry and Physics"}),
    actingWhen("melting_temperature > 0",
               {"latent_heat_fusion", "Latent heat, melting", "L_f", "J/kg", kNumber, kLinear, 2e5, 0, 1e6, 0, 1e8,
                "kJ/kg", 1e-3, 0, "", "Phase change",
                "Heat that one kilogram takes up while it melts, and gives back while it freezes.",
                "water 334, wax 200, iron 247, lead 23 kJ/kg", "CRC Handbook of Chemistry and Physics"}),
    related("must be <= liquidus when melting_temperature > 0",
            actingWhen("melting_temperature > 0", {"solidus", "Melting begins", "T_s", "K", kNumber, kLinear, 273.15,
                                                   50, 2000, 0, 1e4, "°C", 1, kCelsius, "", "Phase change",
                                                   "Below it all is solid. Used when it lies below the temperature at "
                                                   "which melting ends; otherwise the matter melts "
                                                   "sharply at its melting point.",
                                                   "butter 5, chocolate 28, candle wax 54, basalt 1000 °C",
                                                   "Beckett, Industrial Chocolate Manufacture and Use"})),
    actingWhen("melting_temperature > 0", {"liquidus", "Melting ends", "T_l", "K", kNumber, kLinear, 273.15, 50, 2000,
                                           0, 1e4, "°C", 1, kCelsius, "", "Phase change",
                                           "Above it all is liquid. Between the two the liquid share grows evenly, as "
                                           "in butter, chocolate, wax and lava.",
                                           "butter 35, chocolate 34, candle wax 60, basalt 1200 °C",
                                           "Beckett, Industrial Chocolate Manufacture and Use"}),
    actingWhen(
        "melting_temperature > 0",
        {"melting_slope", "Melting point and pressure", "m_p", "K/Pa", kNumber, kLinear, 0, -1e-6, 1e-6, -1e-4, 1e-4,
         "K/MPa", 1e6, 0, "", "Phase change",
         "How far the melting point moves with pressure. Below zero for the few solids that float on their own melt.",
         "water \u22120.074, most metals +0.03 K/MPa", "Wagner, Riethmann, Feistel & Harvey 2011"}),
    related("must be > melting_temperature when boiling_temperature > 0 & melting_temperature > 0 unless "
            "triple_temperature > boiling_temperature & triple_pressure > 101325",
            {"boiling_temperature", "Boiling point", "T_b", "K", kNumber, kLinear, 0, 0, 3500, 0, 1e4, "°C", 1,
             kCelsius, "", "Phase change",
             "Boiling point at 1 atm; the ambient pressure moves it. None: it never boils. For "
             "what turns from solid to gas at 1 atm, such as dry ice: the temperature at which it does.",
             "nitrogen \u2212195.8, ethanol 78.3, water 99.97, lead 1749 °C", "NIST Chemistry WebBook"}),
    actingWhen(
        "boiling_temperature > 0",
        {"latent_heat_vaporization", "Latent heat, boiling", "L_v", "J/kg", kNumber, kLinear, 5e5, 1e5, 1e7, 0, 1e9,
         "kJ/kg", 1e-3, 0, "", "Phase change",
         "Heat that one kilogram takes up while it boils, and gives back while it condenses: why steam burns so badly.",
         "water 2257, ethanol 838, nitrogen 199, iron 6090 kJ/kg", "NIST Chemistry WebBook"}),
    actingWhen(
        "boiling_temperature > 0",
        {"molar_mass", "Molar mass", "M", "kg/mol", kNumber, kLogarithmic, 0, 0, 0.4, 0, 100, "g/mol", 1e3, 0, "",
         "Phase change",
         "Mass of one mole of vapour. It decides how light the vapour is and how far pressure moves the boiling point; "
         "with 0 the boiling point stays where it is and the vapour is as heavy as air of its temperature.",
         "water 18.0, air 29.0, carbon dioxide 44.0, ethanol 46.1 g/mol", "IUPAC atomic weights"}),
    {"triple_temperature", "Triple point, temperature", "T_3", "K", kNumber, kLinear, 0, 0, 2000, 0, 1e4, "°C", 1,
     kCelsius, "", "Phase change",
     "Where solid, liquid and vapour are in balance. None: not known, the boiling curve is then "
     "drawn from the boiling point alone.",
     "water 0.01, carbon dioxide \u221256.6, nitrogen \u2212210.0 °C", "NIST Chemistry WebBook"},
    {"triple_pressure", "Triple point, pressure", "p_3", "Pa", kNumber, kLogarithmic, 0, 0, 1e6, 0, 1e9, "kPa", 1e-3, 0,
     "", "Phase change",
     "Below this pressure there is no liquid: the solid turns straight into vapour, as in freeze-drying.",
     "water 0.612, carbon dioxide 518, nitrogen 12.5 kPa", "NIST Chemistry WebBook"},
    related(
        "must be > 0 when boiling_temperature > 0 & triple_temperature > 0 & triple_pressure > 0 unless "
        "triple_temperature > boiling_temperature & triple_pressure > 101325",
        {"latent_heat_sublimation", "Latent heat, sublimation", "L_s", "J/kg", kNumber, kLinear, 0, 0, 1e7, 0, 1e9,
         "kJ/kg", 1e-3, 0, "", "Phase change",
         "Slope of the curve on which solid turns to vapour. The heat that is really taken up follows from the other "
         "latent heats and heat capacities, so that no energy is lost when the pressure changes.",
         "water 2834, carbon dioxide 571 kJ/kg", "IAPWS R14-08"}),
    related("must be > boiling_temperature when critical_temperature > 0 & boiling_temperature > 0; must be > "
            "triple_temperature when critical_temperature > 0 & triple_temperature > 0 & boiling_temperature > 0",
            actingWhen("boiling_temperature > 0",
                       {"critical_temperature", "Critical temperature", "T_c", "K", kNumber, kLinear, 0, 0, 5000, 0,
                        1e5, "°C", 1, kCelsius, "", "Phase change",
                        "The boiling point rises no further than this, however high the pressure. None: not known.",
                        "water 373.9, carbon dioxide 31.0, ethanol 240.8 °C", "NIST Chemistry WebBook"})),
    actingWhen(
        "boiling_temperature > 0",
        {"gas_volume_factor", "Size of a vapour parcel", "v_g", "", kNumber, kLinear, 2.5, 1, 2.5, 1, 3, "×", 1, 0, "",
         "Phase change",
         "Volume of a vapour particle against the same particle as liquid. Real steam swells 1600 times; the particle "
         "stands for the core of the puff, and its lift still comes from the real density.",
         "1 sluggish bubbles, 2.5 lively boiling", "chosen so that a parcel's own kernel stays below full density"}),
    related("plus freeze_bond_fraction must be > 1",
            {"melt_break_fraction", "Bonds break at melt", "f_b", "", kNumber, kLinear, 0.5, 0.2, 0.9, 0.05, 1, "", 1,
             0, "", "Phase change",
             "Share of a particle that must have melted before it lets go of its neighbours. Each particle draws its "
             "own value around this one, so that a block crumbles instead of dropping layer by layer. Were it too low, "
             "bonds would break and form in every frame.",
             "0.5 melts softly, 0.9 stands until nearly gone", "percolation of partly molten solids, 0.5 to 0.6"}),
    {"freeze_bond_fraction", "Bonds form when frozen", "f_f", "", kNumber, kLinear, 0.9, 0.6, 1, 0.5, 1, "", 1, 0, "",
     "Phase change", "Share of a particle that must be solid before it joins its neighbours.", "0.9 for water and wax",
     ""},
    {"sinters", "Dry pieces freeze together", "", "", kToggle, kLinear, 0, 0, 1, 0, 1, "", 1, 0, "", "Phase change",
     "Whether touching solid pieces of this material grow together without having been liquid.",
     "ice cubes do, iron does not", ""},

    // Mechanics
    {"density_solid", "Density, solid", "ρ_s", "kg/m³", kResponse, kLinear, 1000, 500, 10000, 0.1, 3e4, "", 1, 0, "",
     "Mechanics", "Mass of one cubic metre of the solid; against the liquid's it decides whether the solid floats.",
     "ice 917, wax 900, glass 2500, iron 7874, lead 11340 kg/m³", "CRC Handbook of Chemistry and Physics"},
    {"density_liquid", "Density, liquid", "ρ_l", "kg/m³", kResponse, kLinear, 1000, 500, 10000, 0.1, 3e4, "", 1, 0, "",
     "Mechanics", "Mass of one cubic metre of the liquid; where it falls with temperature, hot liquid rises.",
     "water 998, ethanol 789, molten wax 780, liquid iron 7035 kg/m³", "CRC Handbook of Chemistry and Physics"},
    actingWhen(
        "density_solid = constant",
        {"expansion_linear", "Expansion, solid", "α", "1/K", kNumber, kLinear, 0, 0, 3e-4, -1e-3, 1e-2,
         "10\u207b\u2076/K", 1e6, 0, "", "Mechanics",
         "How much longer the solid grows per degree, counted from 20 °C. A density drawn as a curve takes its place.",
         "glass 9, iron 12, ice 51, wax 150 × 10\u207b\u2076/K", "CRC Handbook of Chemistry and Physics"}),
    actingWhen("density_liquid = constant",
               {"expansion_volumetric", "Expansion, liquid", "β", "1/K", kNumber, kLinear, 0, 0, 2e-3, -1e-2, 5e-2,
                "10\u207b\u2076/K", 1e6, 0, "", "Mechanics",
                "How much more room the liquid takes per degree, counted from 20 °C; it drives convection. A density "
                "drawn as a curve takes its place.",
                "water 207, molten wax 800, ethanol 1090 × 10\u207b\u2076/K", "CRC Handbook of Chemistry and Physics"}),
    {"youngs_modulus", "Young's modulus", "E", "Pa", kResponse, kLogarithmic, 1e7, 1e4, 1e12, 0, 1e13, "MPa", 1e-6, 0,
     "", "Mechanics",
     "Stiffness of the solid, where bonds or clusters hold it together; a rigid body does not give way at all. The "
     "solver reaches a few ten megapascal; beyond that it says how stiff the matter really is.",
     "jelly 0.01, rubber 5, wax 100, ice 9300, steel 210000 MPa", "Gammon et al. 1983 (ice), CRC Handbook"},
    {"poisson_ratio", "Poisson's ratio", "ν", "", kNumber, kLinear, 0.25, 0, 0.49, -0.99, 0.499, "", 1, 0, "",
     "Mechanics",
     "How much the solid narrows when it is stretched: for plugins that ask for it. What holds solids together here "
     "behaves like 0.25 whatever stands here.",
     "cork 0, glass 0.22, ice 0.33, rubber 0.49", "CRC Handbook of Chemistry and Physics"},
    {"viscosity", "Viscosity, liquid", "µ", "Pa·s", kResponse, kLogarithmic, 1e-3, 1e-4, 1e3, 0, 1e15, "mPa·s", 1e3, 0,
     "", "Mechanics",
     "How thick the liquid is. What is too thick for the particle size and time step is shown beside the slider.",
     "water 1.0, molten wax 5, olive oil 80, honey 10000 mPa·s", "CRC Handbook of Chemistry and Physics"},
    {"yield_stress", "Yield stress, liquid", "τ_y", "Pa", kResponse, kLinear, 0, 0, 200, 0, 1e7, "", 1, 0, "",
     "Mechanics",
     "Stress below which the liquid stands instead of flowing, as ketchup does; 0 for what always flows. Above it the "
     "viscosity resists the rest. Below it the solver's matter creeps, by a thousandth per second at most.",
     "molten chocolate 10, ketchup 20, basalt lava 100, toothpaste 200 Pa", "Barnes 1999, The yield stress: a review"},
    {"friction_static", "Friction, resting", "µ_s", "", kNumber, kLinear, 0.3, 0, 1.5, 0, 10, "", 1, 0, "", "Mechanics",
     "Grip before anything slides: a block on a ramp starts to move at the angle whose tangent this is. Between two "
     "materials the mean of theirs counts, on a wall the wall's own.",
     "ice on steel 0.05, wood on wood 0.4, rubber on concrete 1", "CRC Handbook of Chemistry and Physics"},
    {"friction_kinetic", "Friction, sliding", "µ_k", "", kNumber, kLinear, 0.2, 0, 1.5, 0, 10, "", 1, 0, "",
     "Mechanics",
     "Grip while sliding; usually a little less than at rest. Between two materials the mean of theirs counts, on a "
     "wall the wall's own.",
     "ice on steel 0.03, wood on wood 0.3, rubber 0.8", "CRC Handbook of Chemistry and Physics"},
    {"restitution", "Bounce", "e", "", kNumber, kLinear, 0.1, 0, 1, 0, 1, "", 1, 0, "", "Mechanics",
     "Share of its speed that a piece keeps when it hits something; of two materials the one that bounces more counts. "
     "Soft bodies get it as a whole when the impact has gone through them. Cloth, ropes and what hangs on something "
     "fixed hardly bounce: their particles do it one by one, and what ties them takes it up.",
     "clay 0, wood 0.5, glass 0.7, rubber ball 0.8", ""},
    {"bond_radius", "Reach of bonds", "r_b", "", kNumber, kLinear, 1.7, 1.1, 2, 1, 2, "×", 1, 0, "", "Mechanics",
     "How far a freezing particle reaches for neighbours to bond with, in particle spacings.",
     "1.3 soft and brittle, 1.7 as stiff as the block was", ""},

    // Light
    actingWhen(
        "environment/radiation = on",
        {"emissivity", "Emissivity", "ε", "", kNumber, kLinear, 0.9, 0, 1, 0, 1, "", 1, 0, "", "Light",
         "How well the surface radiates and absorbs heat, against a perfect black one. It acts where the scene's heat "
         "radiation is on.",
         "polished metal 0.05, rusty iron 0.8, wax 0.9, ice 0.97",
         "Incropera et al., Fundamentals of Heat and Mass Transfer"}),
    {"clearness", "Clearness", "", "", kNumber, kLinear, 0, 0, 1, 0, 1, "%", 100, 0, "", "Light",
     "How far light goes into the solid, for its look alone: clear matter is frosted and light shines through its "
     "gaps, opaque matter shows its colour.",
     "ice, glass 100 %, jelly 80 %, wax 60 %, wood, iron 0 %", ""},
    {"color_red", "Red", "R", "", kNumber, kLinear, 0.7, 0, 1, 0, 1, "%", 100, 0, "", "Light",
     "Red part of the colour in which the matter is drawn (sRGB).", "ice 75 %, chocolate 29 %, lava 90 %", ""},
    {"color_green", "Green", "G", "", kNumber, kLinear, 0.7, 0, 1, 0, 1, "%", 100, 0, "", "Light",
     "Green part of the colour in which the matter is drawn (sRGB).", "ice 87 %, chocolate 16 %, lava 30 %", ""},
    {"color_blue", "Blue", "B", "", kNumber, kLinear, 0.7, 0, 1, 0, 1, "%", 100, 0, "", "Light",
     "Blue part of the colour in which the matter is drawn (sRGB).", "ice 98 %, chocolate 10 %, lava 10 %", ""},
};

}  // namespace

api::ParameterList propertyCatalogue() { return api::listOf(kProperties); }

int propertyIndex(std::string_view key) {
  int index = 0;
  for (const ParameterDeclaration& declaration : kProperties) {
    if (key == declaration.key) return index;
    ++index;
  }
  return -1;
}

}  // namespace ps
