// SPDX-License-Identifier: Apache-2.0
#include "ui/window/solidrows.h"

#include "core/base/digits.h"
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"

#include <algorithm>

namespace ps {
namespace {

using Kind = SolidForm::Kind;

constexpr SolidRow kRows[] = {{Kind::Ellipsoid, "Ellipsoid", "ball sphere"},
                              {Kind::Block, "Block", "box cube"},
                              {Kind::Cylinder, "Cylinder"},
                              {Kind::Cone, "Cone"},
                              {Kind::Capsule, "Capsule"},
                              {Kind::Torus, "Torus", "ring doughnut"},
                              {Kind::Tube, "Tube", "pipe"},
                              {Kind::Bowl, "Bowl", "cup"},
                              {Kind::Sheet, "Sheet", "cloth fabric"},
                              {Kind::Rope, "Rope"},
                              {Kind::Block, "Hot plate", "stove cooker hob heater", "hot-plate", 423.15}};
constexpr double kThinnest = 2;  // spacings, of what holds a temperature: nothing leaks through

/// Id of the installed material of which a number is largest and above 0.
template <class Number>
std::string largestOf(const PluginRegistry& plugins, const Number& number) {
  std::string best;
  double largest = 0;
  for (const std::string& id : plugins.ids(PluginKind::Material)) {
    const Material* material = plugins.material(id);
    const double value = material ? number(*material) : 0;
    if (value > largest) largest = value, best = id;
  }
  return best;
}

/// As the parameter of solids calls it.
std::string nameOf(Kind kind) {
  return choicesOf(*findDeclaration(solidParameters(), "kind"))[static_cast<size_t>(kind)];
}

void holdAt(double kelvin, ParameterSet& parameters) {
  parameters.values["fixed"] = true;
  parameters.values["temperature"] = kelvin;
  parameters.values["heat"] = std::string("fixed_temperature");
  parameters.values["held_temperature"] = kelvin;
}

}  // namespace

std::span<const SolidRow> solidRows() { return kRows; }

std::string idOf(const SolidRow& row) { return row.id ? row.id : nameOf(row.kind); }

Body solidBody(const SolidRow& row, double size, double spacing) {
  Body body;
  body.id = idOf(row);
  body.name = row.name;
  SolidShape solid;
  auto& values = solid.parameters.values;
  values["kind"] = nameOf(row.kind);
  values["size_x"] = size;
  values["size_y"] = size;
  values["size_z"] = size;
  if (row.kind == Kind::Tube) values["wall"] = toDigits(size / 5, 2);
  if (row.kind == Kind::Torus) {  // particles leave a hole in it
    values["size_x"] = values["size_z"] = 2 * size;
    values["size_y"] = toDigits(size / 2, 2);
  }
  if (row.kind == Kind::Bowl) {
    values["size_x"] = values["size_z"] = 2 * size;  // it must hold something
    values["wall"] = toDigits(std::max(size / 8, spacing), 2);
  }
  if (row.kind == Kind::Sheet || row.kind == Kind::Rope) values["size_y"] = spacing;
  if (row.kind == Kind::Sheet) values["size_x"] = values["size_z"] = 2 * size;
  if (row.kind == Kind::Rope) {
    values.erase("size_x");
    values.erase("size_z");
    values["point_1_x"] = -size;
    values["point_2_x"] = size;
  }
  if (row.held > 0) {
    values["size_x"] = values["size_z"] = 2 * size;
    values["size_y"] = std::max(kThinnest * spacing, toDigits(size / 8, 2));
    holdAt(row.held, body.parameters);
  }
  body.shape = std::move(solid);
  return body;
}

std::string lastToMelt(const PluginRegistry& plugins) {
  return largestOf(plugins, [](const Material& material) { return phaseDiagramOf(material).meltingPoint0; });
}

std::string bestConductor(const PluginRegistry& plugins, double kelvin) {
  return largestOf(plugins, [kelvin](const Material& material) {
    return phaseDiagramOf(material).meltingPoint0 > kelvin ? valueOf(material, "conductivity_solid", kelvin) : 0;
  });
}

}  // namespace ps
