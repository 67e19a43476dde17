// SPDX-License-Identifier: Apache-2.0
// A material that is a JSON file alone: refused with a sentence, or what the solver takes from it is in its range.
#include "core/plugin_host/materialjson.h"
#include "tests/fuzz/fuzz.h"

#include <cmath>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace ps;
  constexpr double kPressure = 101325;  // Pa
  PluginInfo info;
  try {
    const Material material = parseMaterialJson(fuzz::textOf(data, size), fuzz::kName, info);
    fuzz::require(material.id == info.id && !info.label.empty() && !info.licence.empty(), "a material says who it is");
    const BakedMaterial baked(material, kPressure);
    const api::ParameterList catalogue = propertyCatalogue();
    for (const double temperature : {0.0, 1.0, 273.15, 1000.0, 6000.0}) {
      for (size_t i = 0; i < catalogue.count; ++i) {
        const double value = baked.property(catalogue[i].key, temperature);
        fuzz::require(value >= catalogue[i].hardMinimum && value <= catalogue[i].hardMaximum,
                      std::string(catalogue[i].key) + " is in its range at every temperature");
      }
      for (const auto& [solid, liquid, gas] :
           {std::array{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}, {0.5, 0.5, 0.0}}) {
        const double density = baked.restDensity(temperature, solid, liquid, gas);
        fuzz::require(density > 0 && std::isfinite(density), "matter has a density");
      }
      fuzz::require(std::isfinite(baked.kirchhoff(temperature)), "heat flows by a number");
    }
  } catch (const InputError& problem) {
    fuzz::requireMessage(problem.what());
  }
  return 0;
}
