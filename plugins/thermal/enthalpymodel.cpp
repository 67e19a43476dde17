// SPDX-License-Identifier: Apache-2.0
#include "enthalpymodel.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ps::thermal {
namespace {

constexpr const char* kEnthalpy = "specific_enthalpy";

double* enthalpyOf(const api::ParticleView& particles) {
  auto* field = static_cast<double*>(particles.fields->write(kEnthalpy, api::FieldType::Float64));
  if (!field) throw std::runtime_error("the particles have no field 'specific_enthalpy'");
  return field;
}

const api::Caloric& caloricOf(const api::ThermalContext& context, const api::ParticleView& particles, size_t i) {
  return context.materials[particles.material[i]]->caloric();
}

}  // namespace

double solidEnthalpy(const api::Caloric& c, double t) { return c.heatCapacitySolid * (t - c.meltingPoint0); }

double liquidEnthalpy(const api::Caloric& c, double t) {
  return c.latentHeatFusion + c.heatCapacityLiquid * (t - c.meltingPoint0);
}

double gasEnthalpy(const api::Caloric& c, double t) {
  return liquidEnthalpy(c, c.boilingPoint0) + c.latentHeatVaporization + c.heatCapacityGas * (t - c.boilingPoint0);
}

namespace {

ThermalState solidAt(const api::Caloric& c, double h) { return {c.meltingPoint0 + h / c.heatCapacitySolid, 1, 0, 0}; }

ThermalState gasAt(const api::Caloric& c, double h) {
  const double reference = liquidEnthalpy(c, c.boilingPoint0) + c.latentHeatVaporization;
  return {c.boilingPoint0 + (h - reference) / c.heatCapacityGas, 0, 0, 1};
}

ThermalState sublimingAt(const api::Caloric& c, double h) {
  const double t = c.meltingPoint, low = solidEnthalpy(c, t), high = gasEnthalpy(c, t);
  if (h < low) return solidAt(c, h);
  if (h > high || high <= low) return gasAt(c, h);
  const double f = (h - low) / (high - low);
  return {t, 1 - f, 0, f};
}

}  // namespace

ThermalState stateAt(const api::Caloric& c, double h) {
  if (c.sublimes) return sublimingAt(c, h);
  if (c.melts) {
    const double low = solidEnthalpy(c, c.solidus), high = liquidEnthalpy(c, c.liquidus);
    if (h < low) return solidAt(c, h);
    if (h < high) {
      const double f = (h - low) / (high - low);
      return {c.solidus + f * (c.liquidus - c.solidus), 1 - f, f, 0};
    }
  }
  if (std::isfinite(c.boilingPoint)) {
    const double low = liquidEnthalpy(c, c.boilingPoint), high = gasEnthalpy(c, c.boilingPoint);
    if (h > high) return gasAt(c, h);
    if (h > low && high > low) {
      const double f = (h - low) / (high - low);
      return {c.boilingPoint, 0, 1 - f, f};
    }
  }
  return {c.meltingPoint0 + (h - c.latentHeatFusion) / c.heatCapacityLiquid, 0, 1, 0};
}

namespace {

enum class Stable { Solid, Liquid, Gas };

Stable stableAt(const api::Caloric& c, double t) {
  if ((c.melts || c.sublimes) && t < c.solidus) return Stable::Solid;
  return t < c.boilingPoint ? Stable::Liquid : Stable::Gas;
}

double heldBy(const api::Caloric& c, double t, Stable phase) {
  if (phase == Stable::Solid) return solidEnthalpy(c, t);
  return phase == Stable::Liquid ? liquidEnthalpy(c, t) : gasEnthalpy(c, t);
}

}  // namespace

double enthalpyAt(const api::Caloric& c, double t, double solid, double liquid, double gas) {
  const bool range = c.melts && !c.sublimes && c.liquidus > c.solidus;
  if (range && t >= c.solidus && t <= c.liquidus && !(gas > 0)) {
    const double low = solidEnthalpy(c, c.solidus), high = liquidEnthalpy(c, c.liquidus);
    return low + (t - c.solidus) / (c.liquidus - c.solidus) * (high - low);
  }
  const Stable stable = stableAt(c, t);
  const double balanced = heldBy(c, t, stable);
  const auto held = [&](Stable phase, bool exists) {
    if (phase == stable || !exists) return balanced;
    const double alone = heldBy(c, t, phase);
    return phase < stable ? std::min(alone, balanced) : std::max(alone, balanced);
  };
  double h = 0;
  if (solid > 0) h += solid * held(Stable::Solid, c.melts || c.sublimes);
  if (liquid > 0) h += liquid * held(Stable::Liquid, true);
  if (gas > 0) h += gas * held(Stable::Gas, std::isfinite(c.boilingPoint0));
  return h;
}

EnthalpyModel::EnthalpyModel()
    : Described({"Enthalpy",
                 "Each particle carries its specific enthalpy; temperature and the shares of solid, liquid and vapour "
                 "follow from it (Voller & Cross 1981). No heat is lost at a plateau whatever the step, melting and "
                 "freezing are one law run both ways, a melting range and sublimation are included, and a change of "
                 "pressure keeps the energy. Matter is always in balance: no supercooling, no evaporation below the "
                 "boiling point, one heat capacity per phase. A body that is told to begin in another phase than its "
                 "temperature and pressure allow begins with that phase's heat, and is at once what that heat means: "
                 "liquid water of 90 °C at 50 kPa is 81 °C and 1.6 % vapour.",
                 {}}) {}

api::List<api::FieldDeclaration> EnthalpyModel::fields() const noexcept {
  static const api::FieldDeclaration list[] = {{kEnthalpy, "J/kg", "Heat content, 0 for the solid at its melting point",
                                                api::FieldType::Float64, "Specific enthalpy"}};
  return api::listOf(list);
}

void EnthalpyModel::initialise(const api::ThermalContext& context, const api::ParticleView& particles, size_t first,
                               size_t last, const double* temperature, const api::Phase*) const {
  double* h = enthalpyOf(particles);
  for (size_t i = first; i < last; ++i) {
    h[i] = enthalpyAt(caloricOf(context, particles, i), temperature[i], double{particles.solidFraction[i]},
                      double{particles.liquidFraction[i]}, double{particles.gasFraction[i]});
  }
}

void EnthalpyModel::addHeat(const api::ThermalContext&, const api::ParticleView& particles, size_t first, size_t last,
                            const double* joules, double) const {
  double* h = enthalpyOf(particles);
  for (size_t i = first; i < last; ++i) {
    if (particles.mass[i] > 0) h[i] += joules[i] / static_cast<double>(particles.mass[i]);
  }
}

void EnthalpyModel::derive(const api::ThermalContext& context, const api::ParticleView& particles, size_t first,
                           size_t last, const api::ThermalOutput& output) const {
  const double* h = enthalpyOf(particles);
  for (size_t i = first; i < last; ++i) {
    const ThermalState state = stateAt(caloricOf(context, particles, i), h[i]);
    output.temperature[i] = state.temperature;
    output.solidFraction[i] = static_cast<float>(state.solid);
    output.liquidFraction[i] = static_cast<float>(state.liquid);
    output.gasFraction[i] = static_cast<float>(state.gas);
  }
}

void EnthalpyModel::energy(const api::ThermalContext&, const api::ParticleView& particles, size_t first, size_t last,
                           double* joules) const {
  const double* h = enthalpyOf(particles);
  for (size_t i = first; i < last; ++i) joules[i] = h[i] * static_cast<double>(particles.mass[i]);
}

}  // namespace ps::thermal
