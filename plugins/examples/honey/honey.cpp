// SPDX-License-Identifier: MIT
#include "honey.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace {

using namespace ps::api;

constexpr double kGasConstant = 8.314462618;  // J/(mol K)
constexpr double kReference = 293.15;         // K
constexpr double kViscosity = 20;             // Pa s at kReference and kMoisture
constexpr double kActivation = 95e3;          // J/mol
constexpr double kMoisture = 0.17;            // mass fraction
constexpr double kPerMoisture = 60;           // logarithm of viscosity per unit of mass fraction

// Declared once: the editor makes the slider, the project file the key, from this.
constexpr ParameterDeclaration kParameters[] = {
    {"moisture", "Moisture", "w", "", ParameterKind::Number, Scale::Linear, kMoisture, 0.13, 0.25, 0.1, 0.3, "%", 100,
     0, "", "Flow", "Mass of water in the honey; every percent nearly halves the viscosity.",
     "heather honey 21 %, acacia 17 %, old and thick 14 %", ""}};

constexpr MaterialProperty constant(const char* key, double value, const char* source, char grade) {
  return {key, {.kind = ResponseSpec::Kind::Constant, .constant = value}, source, grade};
}
constexpr const char* kTypical = "typical of honeys of 17 % moisture";
constexpr MaterialProperty kProperties[] = {
    constant("density_liquid", 1420, kTypical, 'C'),
    constant("density_solid", 1450, kTypical, 'C'),
    constant("heat_capacity_liquid", 2260, kTypical, 'C'),
    constant("heat_capacity_solid", 2260, kTypical, 'C'),
    constant("conductivity_liquid", 0.35, kTypical, 'C'),
    constant("conductivity_solid", 0.35, kTypical, 'C'),
    constant("melting_temperature", 0, "a glass former: it never melts, it grows thin", 'B'),
    constant("clearness", 1, "", 'C'),
    constant("color_red", 0.85, "", 'C'),
    constant("color_green", 0.55, "", 'C'),
    constant("color_blue", 0.1, "", 'C')};

}  // namespace

Honey::Honey()
    : Described(
          {"Honey",
           "Clear honey, a liquid at every temperature. Viscosity follows Arrhenius's law and falls exponentially with "
           "moisture; the figures are representative and hold from 5 to 60 °C. It neither crystallises nor boils.",
           listOf(kParameters)}) {}

List<MaterialProperty> Honey::properties() const noexcept { return listOf(kProperties); }

bool Honey::evaluate(const char* key, Span<const double> parameters, Span<const double> temperature,
                     Span<double> out) const {
  if (std::strcmp(key, "viscosity") != 0) return false;
  const double moisture = parameters.size > 0 ? parameters[0] : kMoisture;
  for (size_t i = 0; i < temperature.size; ++i) {
    const double logarithm = std::log(kViscosity) + kActivation / kGasConstant * (1 / temperature[i] - 1 / kReference) -
                             kPerMoisture * (moisture - kMoisture);
    // The host asks from 1 K on, where the law knows no bounds: cold honey is a glass, hot honey is thin as syrup.
    out[i] = std::exp(std::clamp(logarithm, std::log(1e-2), std::log(1e6)));
  }
  return true;
}
