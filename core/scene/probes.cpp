// SPDX-License-Identifier: Apache-2.0
#include "core/scene/project.h"

#include <algorithm>

namespace ps {
namespace {

struct Quantity {
  const char *key, *label, *unit;
};

constexpr Quantity kQuantities[] = {
    {"temperature", "Mean temperature", "K"},
    {"temperature_min", "Lowest temperature", "K"},
    {"temperature_max", "Highest temperature", "K"},
    {"mass", "Mass", "kg"},
    {"count", "Particles", "1"},
    {"solid_mass", "Solid mass", "kg"},
    {"melting_mass", "Melting mass", "kg"},
    {"liquid_mass", "Liquid mass", "kg"},
    {"boiling_mass", "Boiling mass", "kg"},
    {"gas_mass", "Gas mass", "kg"},
    {"speed", "Mean speed", "m/s"},
    {"speed_max", "Highest speed", "m/s"},
    {"height", "Mean height", "m"},
    {"height_max", "Highest point", "m"},
    {"thermal_energy", "Thermal energy", "J"},
    {"kinetic_energy", "Kinetic energy", "J"},
};

const Quantity* find(const std::string& key) {
  const auto* q =
      std::find_if(std::begin(kQuantities), std::end(kQuantities), [&](const Quantity& k) { return key == k.key; });
  return q == std::end(kQuantities) ? nullptr : q;
}

}  // namespace

const std::vector<std::string>& probeQuantities() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    for (const Quantity& q : kQuantities) all.emplace_back(q.key);
    return all;
  }();
  return keys;
}

std::string probeUnit(const std::string& quantity) {
  const Quantity* q = find(quantity);
  return q ? q->unit : "";
}

std::string probeLabel(const std::string& quantity) {
  const Quantity* q = find(quantity);
  return q ? q->label : "";
}

}  // namespace ps
