// SPDX-License-Identifier: Apache-2.0
#include "core/matter/material.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

constexpr size_t kSamples = 2048;
/// A viscosity may change by a tenth per kelvin: lines between samples 0.18 K apart err by less than 1e-4.
constexpr size_t kViscositySamples = 16384;
constexpr double kReferenceTemperature = 293.15;  // K, where constants of densities hold

Response responseOf(const Material& material, const char* key) {
  const auto found = material.properties.find(key);
  if (found != material.properties.end()) return found->second;
  return propertyCatalogue()[static_cast<size_t>(propertyIndex(key))].defaultValue;
}

/// Tables of a material's values from 1 K to `last` K, held within each property's hard range: a law is sound where it
/// was fitted, and far from there a conductivity would turn negative or a viscosity endless. What is no number becomes
/// the minimum. Where values were held is noted.
class Baker {
 public:
  Baker(const Material& material, double last) : m_material(material), m_last(last) {}

  /// Constants need no samples.
  ResponseTable table(const char* key, size_t samples = kSamples) {
    const Response response = responseOf(m_material, key);
    return tableOf(key, response.kind == Response::Kind::Constant ? 2 : samples,
                   [&](double t) { return response.at(t); });
  }

  /// A density over temperature: a curve as it is, a constant with its expansion, rho0/(1 + beta (T - reference)).
  ResponseTable density(const char* key, double expansion, double reference) {
    const Response response = responseOf(m_material, key);
    if (response.kind != Response::Kind::Constant || expansion == 0) return table(key);
    return tableOf(key, kSamples,
                   [&](double t) { return response.constant / std::max(0.2, 1 + expansion * (t - reference)); });
  }

  std::vector<HeldRange> takeHeld() { return std::move(m_held); }

 private:
  template <class ValueAt>
  ResponseTable tableOf(const char* key, size_t samples, ValueAt valueAt) {
    const int property = propertyIndex(key);
    const api::ParameterDeclaration& range = propertyCatalogue()[static_cast<size_t>(property)];
    const bool endless = std::string_view(key) == "viscosity";
    std::vector<double> values(samples);
    bool holding = false;
    for (size_t i = 0; i < samples; ++i) {
      const double t = 1 + (m_last - 1) * static_cast<double>(i) / static_cast<double>(samples - 1);
      const double value = valueAt(t);
      values[i] = value > range.hardMinimum ? std::min(value, range.hardMaximum) : range.hardMinimum;
      const bool held = values[i] != value && !(endless && value > range.hardMaximum);
      if (held && holding && m_held.back().used == values[i]) {
        m_held.back().to = t;
      } else if (held) {
        m_held.push_back({property, i == 0 ? 0 : t, t, values[i]});
      }
      holding = held;
    }
    if (holding) m_held.back().to = std::numeric_limits<double>::infinity();
    return ResponseTable(std::move(values), 1.0, m_last);
  }

  const Material& m_material;
  double m_last;
  std::vector<HeldRange> m_held;
};

api::Caloric caloricOf(const Material& material, double pressure) {
  const PhaseDiagram diagram = phaseDiagramOf(material);
  const auto value = [&](const char* key) { return valueOf(material, key, kReferenceTemperature); };
  api::Caloric c{};
  c.heatCapacitySolid = value("heat_capacity_solid");
  c.heatCapacityLiquid = value("heat_capacity_liquid");
  c.heatCapacityGas = value("heat_capacity_gas");
  c.melts = diagram.meltingPoint0 > 0;
  c.meltingPoint0 = c.melts ? diagram.meltingPoint0 : 273.15;
  c.latentHeatFusion = c.melts ? value("latent_heat_fusion") : 0;
  const bool boils = diagram.boilingPoint0 > 0;
  c.boilingPoint0 = boils ? diagram.boilingReference() : std::numeric_limits<double>::infinity();
  c.latentHeatVaporization = boils ? value("latent_heat_vaporization") : 0;
  c.boilingPoint = diagram.boilingPoint(pressure);
  c.sublimes = diagram.sublimes(pressure);
  if (c.sublimes) {
    c.meltingPoint = c.boilingPoint = c.solidus = c.liquidus = diagram.sublimationPoint(pressure);
    return c;
  }
  c.meltingPoint = diagram.meltingPoint(pressure);
  c.solidus = c.liquidus = c.meltingPoint;
  const double solidus = value("solidus"), liquidus = value("liquidus");
  if (c.melts && solidus < liquidus) {
    const double shift = c.meltingPoint - diagram.meltingPoint0;
    c.solidus = solidus + shift;
    c.liquidus = std::min(liquidus + shift, c.boilingPoint);
  }
  return c;
}

}  // namespace

struct BakedMaterial::Tables {
  ResponseTable densitySolid, densityLiquid, conductivitySolid, conductivityLiquid, conductivityGas, mush,
      youngsModulus, viscosity, yieldStress;
  std::vector<const ResponseTable*> byProperty;  ///< nullptr for a plain number
  double solidus = 0, liquidus = 0, boilingPoint = 0;
  double kirchhoffSolidus = 0, kirchhoffLiquidus = 0, kirchhoffMush = 0, kirchhoffBoiling = 0, kirchhoffGas = 0;
  double gasVolumeFactor = 1;
  std::vector<HeldRange> held;

  Tables(const Material& material, const api::Caloric& caloric) {
    double last = 3000;
    if (std::isfinite(caloric.boilingPoint)) last = std::max(last, 1.25 * caloric.boilingPoint);
    Baker baker(material, last);
    conductivitySolid = baker.table("conductivity_solid");
    conductivityLiquid = baker.table("conductivity_liquid");
    conductivityGas = baker.table("conductivity_gas");
    youngsModulus = baker.table("youngs_modulus");
    viscosity = baker.table("viscosity", kViscositySamples);
    yieldStress = baker.table("yield_stress");
    bakeDensities(baker, material, caloric);
    held = baker.takeHeld();
    bakeKirchhoff(caloric);
    gasVolumeFactor = valueOf(material, "gas_volume_factor", kReferenceTemperature);
    byProperty.assign(propertyCatalogue().count, nullptr);
    const auto name = [&](const char* key, const ResponseTable& table) {
      byProperty[static_cast<size_t>(propertyIndex(key))] = &table;
    };
    name("conductivity_solid", conductivitySolid);
    name("conductivity_liquid", conductivityLiquid);
    name("conductivity_gas", conductivityGas);
    name("density_solid", densitySolid);
    name("density_liquid", densityLiquid);
    name("youngs_modulus", youngsModulus);
    name("viscosity", viscosity);
    name("yield_stress", yieldStress);
  }

 private:
  void bakeDensities(Baker& baker, const Material& material, const api::Caloric& c) {
    const double solidReference = c.melts ? std::min(kReferenceTemperature, c.solidus) : kReferenceTemperature;
    double liquidReference = c.melts ? std::max(kReferenceTemperature, c.liquidus) : kReferenceTemperature;
    liquidReference = std::min(liquidReference, c.boilingPoint);
    const double linear = valueOf(material, "expansion_linear", kReferenceTemperature);
    densitySolid = baker.density("density_solid", 3 * linear, solidReference);
    densityLiquid = baker.density("density_liquid", valueOf(material, "expansion_volumetric", kReferenceTemperature),
                                  liquidReference);
  }

  void bakeKirchhoff(const api::Caloric& c) {
    boilingPoint = c.boilingPoint;
    solidus = c.melts ? c.solidus : 0;
    liquidus = c.melts ? c.liquidus : 0;
    kirchhoffSolidus = conductivitySolid.integral(solidus);
    kirchhoffLiquidus = conductivityLiquid.integral(liquidus);
    if (liquidus > solidus) {
      std::vector<double> values(65);
      for (size_t i = 0; i < values.size(); ++i) {
        const double f = static_cast<double>(i) / 64, t = solidus + f * (liquidus - solidus);
        values[i] = (1 - f) * conductivitySolid.at(t) + f * conductivityLiquid.at(t);
      }
      mush = ResponseTable(std::move(values), solidus, liquidus);
      kirchhoffMush = mush.integral(liquidus);
    }
    if (!std::isfinite(boilingPoint)) return;
    kirchhoffBoiling = kirchhoffMush + conductivityLiquid.integral(boilingPoint) - kirchhoffLiquidus;
    kirchhoffGas = conductivityGas.integral(boilingPoint);
  }
};

BakedMaterial::BakedMaterial(const Material& material, double pressure)
    : m_id(material.id), m_adheresTo(material.adheresTo), m_caloric(caloricOf(material, pressure)) {
  const api::ParameterList list = propertyCatalogue();
  m_scalars.resize(list.count);
  for (size_t i = 0; i < list.count; ++i) m_scalars[i] = valueOf(material, list[i].key, kReferenceTemperature);
  m_tables = std::make_shared<const Tables>(material, m_caloric);
}

double BakedMaterial::property(const char* key, double temperature) const noexcept {
  const int index = key ? propertyIndex(key) : -1;
  if (index < 0) return std::numeric_limits<double>::quiet_NaN();
  const ResponseTable* table = m_tables->byProperty[static_cast<size_t>(index)];
  return table ? table->at(temperature) : m_scalars[static_cast<size_t>(index)];
}

bool BakedMaterial::adheresTo(const api::MaterialView& other) const noexcept {
  return std::find(m_adheresTo.begin(), m_adheresTo.end(), std::string_view(other.id())) != m_adheresTo.end();
}

double BakedMaterial::restDensity(double temperature, double solid, double liquid, double gas) const {
  const Tables& t = *m_tables;
  double volume = 0;  // m3/kg
  if (solid > 0) volume += solid / t.densitySolid.at(temperature);
  if (liquid > 0) volume += liquid / t.densityLiquid.at(temperature);
  if (gas > 0) volume += gas * t.gasVolumeFactor / t.densityLiquid.at(std::min(temperature, t.boilingPoint));
  return volume > 0 ? 1 / volume : t.densityLiquid.at(temperature);
}

double BakedMaterial::condensedDensity(double temperature, double solid) const {
  const Tables& t = *m_tables;
  const double liquid = t.densityLiquid.at(std::min(temperature, t.boilingPoint));
  if (!(solid > 0)) return liquid;
  const double frozen = t.densitySolid.at(temperature);
  return solid >= 1 ? frozen : 1 / (solid / frozen + (1 - solid) / liquid);
}

double BakedMaterial::conductivity(double temperature, double solid, double liquid, double gas) const {
  const Tables& t = *m_tables;
  double k = 0;
  if (solid > 0) k += solid * t.conductivitySolid.at(temperature);
  if (liquid > 0) k += liquid * t.conductivityLiquid.at(temperature);
  if (gas > 0) k += gas * t.conductivityGas.at(temperature);
  return k;
}

double BakedMaterial::kirchhoff(double temperature) const {
  const Tables& t = *m_tables;
  if (temperature > t.boilingPoint) {
    return t.kirchhoffBoiling + t.conductivityGas.integral(temperature) - t.kirchhoffGas;
  }
  if (temperature <= t.solidus) return t.conductivitySolid.integral(temperature) - t.kirchhoffSolidus;
  if (temperature < t.liquidus) return t.mush.integral(temperature);
  return t.kirchhoffMush + t.conductivityLiquid.integral(temperature) - t.kirchhoffLiquidus;
}

std::span<const HeldRange> BakedMaterial::heldRanges() const { return m_tables->held; }

double BakedMaterial::youngsModulus(double temperature) const { return m_tables->youngsModulus.at(temperature); }

double BakedMaterial::viscosity(double temperature) const { return m_tables->viscosity.at(temperature); }

double BakedMaterial::yieldStress(double temperature) const { return m_tables->yieldStress.at(temperature); }

}  // namespace ps
