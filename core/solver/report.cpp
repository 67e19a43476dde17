// SPDX-License-Identifier: Apache-2.0
#include "core/solver/report.h"

#include <cstdio>

namespace ps {

std::string useOf(const char* address, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "=%.6g", value);
  return std::string(address) + text;
}

std::vector<std::string> flagNames(StepFlags flags) {
  static constexpr struct {
    StepFlag flag;
    const char* name;
  } kNames[] = {{StepFlag::NotFinite, "not_finite"},   {StepFlag::LostParticle, "lost_particle"},
                {StepFlag::Diverged, "diverged"},      {StepFlag::PluginFault, "plugin_fault"},
                {StepFlag::EnergyOpen, "energy_open"}, {StepFlag::Unphysical, "unphysical"}};
  std::vector<std::string> names;
  for (const auto& entry : kNames) {
    if ((flags & static_cast<StepFlags>(entry.flag)) != 0) names.emplace_back(entry.name);
  }
  return names;
}

const char* partName(MechanicalRecord::Part part) {
  using Part = MechanicalRecord::Part;
  switch (part) {
    case Part::Surroundings:
      return "surroundings";
    case Part::Structure:
      return "structure";
    case Part::Pressure:
      return "pressure";
    case Part::Contact:
      return "contact";
    case Part::Viscosity:
      return "viscosity";
    case Part::Impact:
      return "impact";
    case Part::Scheme:
      return "scheme";
    case Part::Count:
      break;
  }
  return "";
}

const char* stageName(Stage stage) {
  switch (stage) {
    case Stage::Neighbours:
      return "neighbours";
    case Stage::Density:
      return "density";
    case Stage::Structure:
      return "structure";
    case Stage::Contact:
      return "contact";
    case Stage::Viscosity:
      return "viscosity";
    case Stage::Heat:
      return "heat";
    case Stage::Phase:
      return "phase";
    case Stage::Count:
      break;
  }
  return "";
}

}  // namespace ps
