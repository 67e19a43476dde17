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
  const auto named = [&](const auto& items, auto name) {
    const auto item = itemById(items, address.id);
    const bool known = item != items.end() && !((*item).*name).empty();
    return QString::fromStdString(known ? (*item).*name : address.id);
  };
  switch (address.owner) {
    case Owner::Material:
      return named(project.materials, &SceneMaterial::label);
    case Owner::Wall:
      return named(project.environment.walls, &SceneWall::name);
    case Owner::Emitter:
      return named(project.emitters, &Emitter::name);
    case Owner::Sink:
      return named(project.sinks, &Sink::name);
    case Owner::Body:
    case Owner::Constraint:
      return named(project.bodies, &Body::name);
    case Owner::Environment:
      return QStringLiteral("Air");
    case Owner::Solver:
      return QStringLiteral("Solver");
    case Owner::Thermal:
      return QStringLiteral("Thermal model");
    case Owner::Scene:
      return QStringLiteral("Scene");
  }
  return {};
}

QString awayLabel(const Project& project, const Address& address, const QString& label) {
  // A material's own rows say what they are of; those of the only owner of their kind need no name.
  if (address.id.empty() || address.owner == Owner::Material) return label;
  return ownerLabel(project, address) + QLatin1Char(' ') + label.left(1).toLower() + label.mid(1);
}

QColor colourOf(const Project& project, const PluginRegistry* plugins, const std::string& material) {
  const auto channel = [&](const char* key) {
    const Value value = valueAt(project, plugins, {Owner::Material, material, key});
    const auto* number = std::get_if<double>(&value);
    const auto* response = std::get_if<Response>(&value);
    return static_cast<float>(std::clamp(number ? *number : response ? response->at(293.15) : 0.5, 0.0, 1.0));
  };
  return QColor::fromRgbF(channel("color_red"), channel("color_green"), channel("color_blue"));
}

}  // namespace ps
