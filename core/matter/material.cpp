// SPDX-License-Identifier: Apache-2.0
#include "core/matter/material.h"

#include "core/parameters/wording.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace ps {
namespace {

/// Constants of a material by key; responses are read at 20 °C.
class Values {
 public:
  explicit Values(const Material& material) : m_material(material) {}
  double operator()(const char* key) const { return valueOf(m_material, key, 293.15); }

 private:
  const Material& m_material;
};

std::string celsius(double kelvin) {
  const double rounded = std::round((kelvin - 273.15) * 100) / 100;
  std::string text = std::to_string(rounded);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " °C";
}

std::string number(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 6).ptr};
}

bool mattersAt(std::string_view key, double temperature, double melting, double boiling) {
  const bool solid = key.ends_with("_solid") || key == "youngs_modulus", gas = key.ends_with("_gas");
  if (solid) return melting <= 0 || temperature <= melting;
  if (gas) return boiling > 0 && temperature >= boiling;
  return temperature >= melting && (boiling <= 0 || temperature <= boiling);
}

/// Temperatures in K at which laws are tried: 20 °C, the melting and boiling points, and a grid from half the melting
/// point to half as much again as the boiling point, or around 20 °C where matter neither melts nor boils.
std::vector<double> trialTemperatures(double melting, double boiling) {
  constexpr int kSteps = 48;
  std::vector<double> temperatures{293.15};
  for (const double point : {melting, boiling}) {
    if (point > 0) temperatures.push_back(point);
  }
  const double low = melting > 0 ? 0.5 * melting : boiling > 0 ? 0.5 * boiling : 273.15;
  const double high = boiling > 0 ? 1.5 * boiling : melting > 0 ? 1.25 * melting : 373.15;
  for (int k = 0; k <= kSteps; ++k) temperatures.push_back(low + (high - low) * k / kSteps);
  return temperatures;
}

/// Where its phase exists a law must be a number and not below the property's least, and at 20 °C and the points not
/// above its most; elsewhere tables hold it within. A viscosity may exceed its maximum everywhere: a glass at rest.
std::string lawProblem(const std::string& key, const Response& law, const api::ParameterDeclaration& range,
                       const Values& value) {
  const double melting = value("melting_temperature"), boiling = value("boiling_temperature");
  for (const double kelvin : trialTemperatures(melting, boiling)) {
    if (!mattersAt(key, kelvin, melting, boiling)) continue;
    const double y = law.at(kelvin);
    const bool point = kelvin == 293.15 || kelvin == melting || kelvin == boiling;
    const bool tooLarge = point && y > range.hardMaximum && key != "viscosity";
    if (std::isfinite(y) && y >= range.hardMinimum && !tooLarge) continue;
    return key + ": its law gives " + number(y) + " " + range.unit + " at " + celsius(kelvin) +
           "; it must stay between " + number(range.hardMinimum) + " and " + number(range.hardMaximum);
  }
  return {};
}

std::string rangesOf(const Material& material) {
  const api::ParameterList list = propertyCatalogue();
  for (const auto& [key, response] : material.properties) {
    const int index = propertyIndex(key);
    if (index < 0) return key + ": is not a property of materials";
    if (const std::string problem = response.problem(); !problem.empty()) return key + ": " + problem;
    const api::ParameterDeclaration& declaration = list[static_cast<size_t>(index)];
    if (response.kind != Response::Kind::Constant && declaration.kind != api::ParameterKind::Response) {
      return key + ": must be a number, it cannot follow the temperature";
    }
    if (response.kind != Response::Kind::Law) continue;
    if (std::string problem = lawProblem(key, response, declaration, Values(material)); !problem.empty())
      return problem;
  }
  return {};
}

/// Of the relations that the catalogue's declarations state.
std::string relationProblem(const Values& value) {
  const api::ParameterList list = propertyCatalogue();
  const auto number = [&](std::string_view key) -> std::optional<Value> {
    const int index = propertyIndex(key);
    if (index < 0) return std::nullopt;
    return value(list[static_cast<size_t>(index)].key);
  };
  const auto find = [&](std::string_view key) { return findDeclaration(list, key); };
  const std::optional<Breach> breach = firstBreach(list, number, find, true);
  return breach ? breach->key + ": " + breach->sentence : std::string();
}

/// No relation of two: the latent heat falls with temperature as the heat capacities differ, and must last.
std::string latentProblem(const Material& material, const Values& value) {
  const PhaseDiagram diagram = phaseDiagramOf(material);
  if (diagram.boilingPoint0 <= 0) return {};
  const double latent = diagram.latentHeatVaporization, melting = diagram.meltingPoint0;
  const double slope = value("heat_capacity_liquid") - value("heat_capacity_gas");
  const double reference = diagram.boilingReference(), critical = diagram.criticalTemperature;
  for (const double t : {melting > 0 ? melting : reference, critical > 0 ? critical : reference}) {
    if (latent - slope * (t - reference) <= 0)
      return "latent_heat_vaporization: too small for these heat capacities, it would vanish at " + celsius(t);
  }
  return {};
}

}  // namespace

double valueOf(const Material& material, std::string_view key, double temperature) {
  const int index = propertyIndex(key);
  if (index < 0) return std::nan("");
  const auto found = material.properties.find(std::string(key));
  if (found != material.properties.end()) return found->second.at(temperature);
  return propertyCatalogue()[static_cast<size_t>(index)].defaultValue;
}

bool existsAt(const Material& material, std::string_view key, double temperature) {
  const Values value(material);
  return mattersAt(key, temperature, value("melting_temperature"), value("boiling_temperature"));
}

PhaseDiagram phaseDiagramOf(const Material& material) {
  const Values value(material);
  PhaseDiagram d;
  d.meltingPoint0 = value("melting_temperature");
  d.boilingPoint0 = value("boiling_temperature");
  d.latentHeatVaporization = value("latent_heat_vaporization");
  d.latentHeatSublimation = value("latent_heat_sublimation");
  d.molarMass = value("molar_mass");
  d.tripleTemperature = value("triple_temperature");
  d.triplePressure = value("triple_pressure");
  d.criticalTemperature = value("critical_temperature");
  d.meltingSlope = value("melting_slope");
  return d;
}

std::string problemOf(const Material& material) {
  if (std::string problem = rangesOf(material); !problem.empty()) return problem;
  const Values value(material);
  if (std::string problem = relationProblem(value); !problem.empty()) return problem;
  return latentProblem(material, value);
}

}  // namespace ps
