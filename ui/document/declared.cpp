// SPDX-License-Identifier: Apache-2.0
#include "ui/document/declared.h"

#include <algorithm>

namespace ps {
namespace {

template <class Items>
auto itemById(const Items& items, const std::string& id) {
  return std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.id == id; });
}

}  // namespace

QString ownerLabel(const Project& project, const Address& address) {
  const std::string first = address.id.substr(0, address.id.find('/'));
  std::string name = first;
  if (address.owner == "material") {
    const auto material = itemById(project.materials, first);
    if (material != project.materials.end() && !material->label.empty()) name = material->label;
  } else if (address.owner == "wall") {
    const auto wall = itemById(project.environment.walls, first);
    if (wall != project.environment.walls.end() && !wall->name.empty()) name = wall->name;
  } else if (address.owner == "emitter") {
    const auto emitter = itemById(project.emitters, first);
    if (emitter != project.emitters.end() && !emitter->name.empty()) name = emitter->name;
  } else if (address.owner == "sink") {
    const auto sink = itemById(project.sinks, first);
    if (sink != project.sinks.end() && !sink->name.empty()) name = sink->name;
  } else if (address.owner == "body" || address.owner == "constraint") {
    const auto body = itemById(project.bodies, first);
    if (body != project.bodies.end() && !body->name.empty()) name = body->name;
  } else if (address.owner == "environment") {
    name = "Air";
  } else if (address.owner == "solver") {
    name = "Solver";
  } else if (address.owner == "thermal") {
    name = "Thermal model";
  } else if (address.owner == "scene") {
    name = "Scene";
  }
  return QString::fromStdString(name);
}

QString awayLabel(const Project& project, const Address& address, const QString& label) {
  static constexpr const char* kNamed[] = {"wall", "body", "constraint", "emitter", "sink"};
  if (std::find(std::begin(kNamed), std::end(kNamed), address.owner) == std::end(kNamed)) return label;
  return ownerLabel(project, address) + QLatin1Char(' ') + label.left(1).toLower() + label.mid(1);
}

QColor colourOf(const Project& project, const PluginRegistry* plugins, const std::string& material) {
  const auto channel = [&](const char* key) {
    const Value value = valueAt(project, plugins, {"material", material, key});
    const auto* number = std::get_if<double>(&value);
    const auto* response = std::get_if<Response>(&value);
    return static_cast<float>(std::clamp(number ? *number : response ? response->at(293.15) : 0.5, 0.0, 1.0));
  };
  return QColor::fromRgbF(channel("color_red"), channel("color_green"), channel("color_blue"));
}

}  // namespace ps
