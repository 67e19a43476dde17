// SPDX-License-Identifier: Apache-2.0
#include "ui/film/projectlook.h"

#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/scene/project.h"
#include "ui/render/colourmap.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ps {
namespace {

/// Temperatures that the scene starts from and is driven by.
std::pair<double, double> temperatureRange(const Project& project) {
  double least = numberOf(project.environment.parameters, environmentParameters(), "ambient_temperature"), most = least;
  const auto include = [&](double kelvin) {
    least = std::min(least, kelvin);
    most = std::max(most, kelvin);
  };
  for (const Body& body : project.bodies) include(numberOf(body.parameters, bodyParameters(), "temperature"));
  for (const SceneWall& wall : project.environment.walls) {
    if (!hasTemperature(wall)) continue;
    include(numberOf(wall.parameters, wallParameters(), "temperature"));
  }
  return {least, most > least ? most : least + 1};
}

}  // namespace

Look lookOf(const Project& project, const PluginRegistry& plugins, const std::string& colour) {
  Look look;
  look.colour = colour;
  if (look.colour == "temperature") {
    std::tie(look.rangeMinimum, look.rangeMaximum) = temperatureRange(project);
  }
  if (!project.materials.empty()) {
    const SceneMaterial& first = project.materials.front();
    const auto own = first.properties.values.find("melting_temperature");
    const Material* installed = plugins.material(first.base);
    const auto* response = own == first.properties.values.end() ? nullptr : std::get_if<Response>(&own->second);
    if (response) {
      look.meltingPoint = response->constant;
    } else if (own != first.properties.values.end() && std::holds_alternative<double>(own->second)) {
      look.meltingPoint = std::get<double>(own->second);
    } else if (installed && installed->properties.contains("melting_temperature")) {
      look.meltingPoint = installed->properties.at("melting_temperature").constant;
    }
  }
  return look;
}

std::function<ByteColour(float kelvin)> temperatureColours(const Look& look) {
  const render::ColourTable table("temperature", look.rangeMinimum, look.rangeMaximum, look.meltingPoint);
  return [table](float kelvin) {
    ByteColour bytes{};
    const render::Colour& colour = table.at(kelvin);
    for (size_t k = 0; k < 3; ++k) bytes[k] = static_cast<uint8_t>(std::lround(255 * colour[k]));
    return bytes;
  };
}

}  // namespace ps
