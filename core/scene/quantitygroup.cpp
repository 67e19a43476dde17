// SPDX-License-Identifier: Apache-2.0
#include "core/scene/quantitygroup.h"

#include <algorithm>

namespace ps {
namespace {

struct Group {
  std::string_view title;
  std::vector<std::string_view> stems;  ///< of names: what comes behind, as in "position_x_max", does not matter
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all{
      {"Temperature", {"temperature"}},
      {"Energy", {"thermal_energy", "kinetic_energy", "specific_enthalpy"}},
      {"Mass and particles",
       {"mass", "count", "pieces", "solid_mass", "melting_mass", "liquid_mass", "boiling_mass", "gas_mass", "outside"}},
      {"Share of phases", {"solid_fraction", "liquid_fraction", "gas_fraction"}},
      {"Place and size", {"height", "position", "extent", "front", "gap"}},
      {"Motion", {"speed", "velocity", "momentum", "angular_momentum", "spin"}},
      {"Force and torque", {"force", "torque"}},
      {"Pressure and density", {"pressure", "density", "compression"}},
      {"Other", {}},
  };
  return all;
}

bool isOf(std::string_view quantity, std::string_view stem) {
  return quantity.starts_with(stem) && (quantity.size() == stem.size() || quantity[stem.size()] == '_');
}

}  // namespace

const std::vector<std::string_view>& quantityGroups() {
  static const std::vector<std::string_view> titles = [] {
    std::vector<std::string_view> list;
    for (const Group& group : groups()) list.push_back(group.title);
    return list;
  }();
  return titles;
}

std::string_view quantityGroup(std::string_view quantity) {
  for (const Group& group : groups()) {
    if (std::any_of(group.stems.begin(), group.stems.end(),
                    [&](std::string_view stem) { return isOf(quantity, stem); }))
      return group.title;
  }
  return groups().back().title;
}

}  // namespace ps
