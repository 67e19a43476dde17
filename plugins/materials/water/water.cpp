// SPDX-License-Identifier: Apache-2.0
#include "water.h"

#include <algorithm>
#include <cstring>

namespace {

using ps::api::MaterialProperty;
using ps::api::ParameterDeclaration;
using ps::api::ParameterKind;
using ps::api::ResponseSpec;
using ps::api::Scale;

constexpr ParameterDeclaration kParameters[] = {
    {"density_maximum", "Densest at 4 °C", "", "", ParameterKind::Toggle, Scale::Linear, 1, 0, 1, 0, 1, "", 1, 0, "",
     "Water",
     "Whether water is densest at 4 °C, as it really is; off, it grows steadily with temperature like other liquids.",
     "on: a lake freezes from the top; off: the coldest water sinks to the bottom", "Kell 1975"},
};

constexpr ResponseSpec constant(double value) {
  ResponseSpec spec;
  spec.constant = value;
  return spec;
}

constexpr ResponseSpec law(const char* name, ps::api::Span<const double> coefficients) {
  ResponseSpec spec;
  spec.kind = ResponseSpec::Kind::Law;
  spec.law = name;
  spec.coefficients = coefficients;
  return spec;
}

// mu = 2.414e-5 Pa s * 10^(247.8 K/(T - 140 K)): 1.0018 mPa s at 20 °C, 0.351 at 80 °C; log10(2.414e-5) = -4.617263.
constexpr double kViscosity[] = {-4.617263, 247.8, 140};

constexpr const char* kCrc = "CRC Handbook of Chemistry and Physics";
constexpr const char* kNist = "NIST Chemistry WebBook";
constexpr const char* kIapws = "IAPWS-95 (Wagner and Pruss 2002)";
constexpr const char* kChosen = "chosen for the particle model";

const MaterialProperty kProperties[] = {
    {"density_solid", constant(917), kCrc, 'A'},
    // At 20 °C; the value in force comes from evaluate() unless the density maximum is switched off.
    {"density_liquid", constant(998.2), "Kell 1975, J. Chem. Eng. Data 20, 97", 'A'},
    {"expansion_linear", constant(5.1e-5), kCrc, 'B'},
    {"expansion_volumetric", constant(2.07e-4), "CRC Handbook, at 20 °C", 'A'},
    {"heat_capacity_solid", constant(2100), "CRC Handbook, at 0 °C", 'A'},
    {"heat_capacity_liquid", constant(4186), "CRC Handbook, mean of 0 to 100 °C", 'A'},
    {"heat_capacity_gas", constant(2010), "NIST Chemistry WebBook, steam at 1 atm", 'A'},
    {"conductivity_solid", constant(2.22), "CRC Handbook, at 0 °C", 'A'},
    {"conductivity_liquid", constant(0.598), "Ramires et al. 1995, at 20 °C", 'A'},
    {"conductivity_gas", constant(0.0248), "CRC Handbook, steam at 100 °C", 'A'},
    {"melting_temperature", constant(273.15), kCrc, 'A'},
    {"solidus", constant(273.15), kCrc, 'A'},
    {"liquidus", constant(273.15), kCrc, 'A'},
    {"latent_heat_fusion", constant(333.6e3), kCrc, 'A'},
    {"boiling_temperature", constant(373.124), kIapws, 'A'},
    {"latent_heat_vaporization", constant(2256.5e3), kIapws, 'A'},
    {"latent_heat_sublimation", constant(2834e3), "IAPWS R14-08 (2011)", 'A'},
    {"triple_temperature", constant(273.16), kIapws, 'A'},
    {"triple_pressure", constant(611.657), kIapws, 'A'},
    {"critical_temperature", constant(647.096), kIapws, 'A'},
    {"melting_slope", constant(-7.4e-8), "Wagner, Riethmann, Feistel and Harvey 2011", 'A'},
    {"molar_mass", constant(0.018015), kNist, 'A'},
    {"viscosity", law("vogel", {kViscosity, 3}), "Vogel fit to the data of the CRC Handbook, 0 to 370 °C within 2.5 %",
     'A'},
    {"youngs_modulus", constant(9.3e9), "Gammon et al. 1983, polycrystalline ice", 'A'},
    {"poisson_ratio", constant(0.33), "Gammon et al. 1983, polycrystalline ice", 'A'},
    {"friction_static", constant(0.05), "CRC Handbook, ice on metal", 'C'},
    {"friction_kinetic", constant(0.03), "CRC Handbook, ice on metal", 'C'},
    {"restitution", constant(0.1), kChosen, 'C'},
    {"emissivity", constant(0.96), "Incropera et al., Fundamentals of Heat and Mass Transfer", 'B'},
    {"melt_break_fraction", constant(0.5), kChosen, 'C'},
    {"freeze_bond_fraction", constant(0.9), kChosen, 'C'},
    {"bond_radius", constant(1.7), kChosen, 'C'},
    {"gas_volume_factor", constant(2.5), kChosen, 'C'},
    {"sinters", constant(1), "ice cubes in contact grow together (Faraday 1860)", 'B'},
    {"clearness", constant(1), kChosen, 'C'},
    {"color_red", constant(0.75), kChosen, 'C'},
    {"color_green", constant(0.87), kChosen, 'C'},
    {"color_blue", constant(0.98), kChosen, 'C'},
};

}  // namespace

double waterDensity(double kelvin) {
  const double t = std::clamp(kelvin, 243.15, 423.15) - 273.15;
  const double numerator =
      999.83952 + t * (16.945176 + t * (-7.9870401e-3 + t * (-46.170461e-6 + t * (105.56302e-9 + t * -280.54253e-12))));
  return numerator / (1 + 16.879850e-3 * t);
}

WaterMaterial::WaterMaterial()
    : Described({"Water",
                 "Ice, water and steam, with measured data. The density of the liquid follows Kell (1975) with its "
                 "maximum at 4 °C, held constant below \u221230 and above 150 °C; the viscosity follows a Vogel law. "
                 "Heat capacities are constant in each phase: those of ice fall by a tenth to \u221230 °C in reality. "
                 "Supercooling and dissolved air are not modelled.",
                 ps::api::listOf(kParameters)}) {}

ps::api::List<MaterialProperty> WaterMaterial::properties() const noexcept { return ps::api::listOf(kProperties); }

bool WaterMaterial::evaluate(const char* key, ps::api::Span<const double> parameters,
                             ps::api::Span<const double> kelvin, ps::api::Span<double> out) const {
  if (std::strcmp(key, "density_liquid") != 0) return false;
  if (parameters.size > 0 && parameters[0] == 0) return false;  // then the constant and its expansion hold
  for (size_t i = 0; i < out.size; ++i) out[i] = waterDensity(kelvin[i]);
  return true;
}
