// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/casefunctions.h"

#include "core/base/error.h"
#include "core/math/convection.h"
#include "core/math/response.h"
#include "core/math/thesis.h"

#include <map>

namespace ps {
namespace {

using Numbers = std::vector<double>;

/// E(dT)/E0 by the law that materials may choose.
double thesisStiffness(double difference) {
  constexpr double kAnywhere = 300;  // K
  Response law;
  law.kind = Response::Kind::Law;
  law.law = "thesis_sigmoid";
  law.coefficients = {1, kAnywhere, 1};
  return law.at(kAnywhere + difference);
}

struct Function {
  size_t arguments;
  double (*value)(const Numbers&);
};

const std::map<std::string, Function> kFunctions{
    {"thesis_density_scale", {1, [](const Numbers& a) { return thesisDensityScale(a[0]); }}},
    {"thesis_gravity", {1, [](const Numbers& a) { return thesisGravity(a[0]); }}},
    {"thesis_stiffness", {1, [](const Numbers& a) { return thesisStiffness(a[0]); }}},
    {"rayleigh_number",
     {6,
      [](const Numbers& a) {
        return rayleighNumber({a[0], a[1], a[2], a[3], a[4], a[5]});
      }}},
};

double phaseAt(const api::Caloric& c, double t) {
  if (c.sublimes) return t < c.meltingPoint ? 0 : t > c.meltingPoint ? 2 : 1;
  if (c.melts && t < c.solidus) return 0;
  if (c.melts && t <= c.liquidus) return 0.5;
  return t < c.boilingPoint ? 1 : t > c.boilingPoint ? 2 : 1.5;
}

using Equilibrium = double (*)(const Material&, const api::Caloric&, double pressure, double temperature);

const std::map<std::string, Equilibrium> kEquilibria{
    {"boiling_point",
     [](const Material& m, const api::Caloric&, double p, double) { return phaseDiagramOf(m).boilingPoint(p); }},
    {"melting_point",
     [](const Material& m, const api::Caloric&, double p, double) { return phaseDiagramOf(m).meltingPoint(p); }},
    {"sublimation_point",
     [](const Material& m, const api::Caloric&, double p, double) { return phaseDiagramOf(m).sublimationPoint(p); }},
    {"latent_heat_boiling",
     [](const Material&, const api::Caloric& c, double, double) {
       return c.latentHeatVaporization -
              (c.heatCapacityLiquid - c.heatCapacityGas) * (c.boilingPoint - c.boilingPoint0);
     }},
    {"phase", [](const Material&, const api::Caloric& c, double, double t) { return phaseAt(c, t); }},
};

}  // namespace

std::vector<std::string> equilibriumNames() {
  std::vector<std::string> names;
  for (const auto& [name, value] : kEquilibria) names.push_back(name);
  return names;
}

double equilibriumOf(const Material& material, const std::string& name, double pressure, double temperature) {
  return kEquilibria.at(name)(material, BakedMaterial(material, pressure).caloric(), pressure, temperature);
}

double valueOfFunction(const std::string& name, const std::vector<double>& arguments) {
  const auto found = kFunctions.find(name);
  if (found == kFunctions.end()) throw InputError("there is no function '" + name + "'");
  if (arguments.size() != found->second.arguments) {
    throw InputError("the function '" + name + "' takes " + std::to_string(found->second.arguments) + " arguments");
  }
  return found->second.value(arguments);
}

}  // namespace ps
