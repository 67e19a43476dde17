// SPDX-License-Identifier: Apache-2.0
#include "core/scene/project.h"

#include <algorithm>

namespace ps {
namespace {

struct Quantity {
  std::string key, label, unit;
  bool mean = false;  ///< of something that each particle has
};

Quantity mean(const char* key, const char* label, const char* unit) { return {key, label, unit, true}; }

std::vector<Quantity> allQuantities() {
  std::vector<Quantity> all{
      mean("temperature", "Mean temperature", "K"),
      {"temperature_min", "Lowest temperature", "K"},
      {"temperature_max", "Highest temperature", "K"},
      {"mass", "Mass", "kg"},
      {"count", "Particles", "1"},
      {"pieces", "Pieces of solid matter", "1"},
      {"solid_mass", "Solid mass", "kg"},
      {"melting_mass", "Melting mass", "kg"},
      {"liquid_mass", "Liquid mass", "kg"},
      {"boiling_mass", "Boiling mass", "kg"},
      {"gas_mass", "Gas mass", "kg"},
      mean("solid_fraction", "Share that is solid", "1"),
      mean("liquid_fraction", "Share that is liquid", "1"),
      mean("gas_fraction", "Share that is vapour", "1"),
      mean("speed", "Mean speed", "m/s"),
      {"speed_max", "Highest speed", "m/s"},
      mean("height", "Mean height", "m"),
      {"height_max", "Highest point", "m"},
      {"thermal_energy", "Thermal energy", "J"},
      {"kinetic_energy", "Kinetic energy", "J"},
      mean("compression", "Mean compression", "1"),
      {"compression_max", "Highest compression", "1"},
      {"outside", "Particles beyond a wall", "1"},
      {"gap", "Distance to other bodies", "m"},
  };
  for (const std::string axis : {"x", "y", "z"}) {
    const auto add = [&](const std::string& key, const std::string& end, const std::string& label, const char* unit,
                         bool isMean = false) {
      all.push_back({key + "_" + axis + end, label + " along " + axis, unit, isMean});
    };
    add("position", "", "Mean place", "m", true);
    add("position", "_min", "Lowest place", "m");
    add("position", "_max", "Highest place", "m");
    add("extent", "", "Length", "m");
    add("front", "", "Front", "m");
    add("velocity", "", "Mean velocity", "m/s", true);
    add("velocity", "_min", "Lowest velocity", "m/s");
    add("velocity", "_max", "Highest velocity", "m/s");
    add("momentum", "", "Momentum", "kg·m/s");
    all.push_back({"spin_" + axis, "Spin about " + axis, "rad/s"});
  }
  return all;
}

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> all = allQuantities();
  return all;
}

const Quantity* find(const std::string& key) {
  const std::vector<Quantity>& all = quantities();
  const auto q = std::find_if(all.begin(), all.end(), [&](const Quantity& k) { return key == k.key; });
  return q == all.end() ? nullptr : &*q;
}

}  // namespace

const std::vector<std::string>& probeQuantities() {
  static const std::vector<std::string> keys = [] {
    std::vector<std::string> all;
    for (const Quantity& q : quantities()) all.push_back(q.key);
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

bool probeIsMean(const std::string& quantity) {
  const Quantity* q = find(quantity);
  return q && q->mean;
}

}  // namespace ps
