// SPDX-License-Identifier: Apache-2.0
#include "ui/document/declared.h"

#include "core/plugin_host/registry.h"
#include "core/scene/solidform.h"
#include "core/simulation/probeparameters.h"

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
    case Owner::Shape:
      return named(project.bodies, &Body::name);
    case Owner::Probe:
      return named(project.probes, &Probe::name);
    case Owner::Environment:
      return QStringLiteral("Air");
    case Owner::Solver:
      return QStringLiteral("Solver");
    case Owner::Thermal:
      return QStringLiteral("Thermal model");
    case Owner::HeatSource:
      return QString::fromStdString(address.id);
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

QString pluginLabel(const PluginRegistry* plugins, const std::string& id) {
  for (const PluginInfo& plugin : plugins ? plugins->plugins() : std::vector<PluginInfo>{}) {
    if (plugin.id == id && !plugin.label.empty()) return QString::fromStdString(plugin.label);
  }
  return QString::fromStdString(id);
}

std::vector<std::string> idsByLabel(const PluginRegistry& plugins, PluginKind kind) {
  std::vector<std::string> ids = plugins.ids(kind);
  std::stable_sort(ids.begin(), ids.end(), [&](const std::string& a, const std::string& b) {
    return pluginLabel(&plugins, a).compare(pluginLabel(&plugins, b), Qt::CaseInsensitive) < 0;
  });
  return ids;
}

namespace {

QStringList probeChoiceLabels(const Project& project, const PluginRegistry* plugins, const std::string& key,
                              const api::ParameterDeclaration& declaration) {
  const ParticleFields fields = plugins ? ParticleFields(*plugins) : ParticleFields();
  QStringList labels;
  for (const QString& name : QString::fromUtf8(declaration.choices).split(QLatin1Char('|'))) {
    const std::string id = name.toStdString();
    if (id == kProbeAll) {
      labels << (key == "wall" ? QStringLiteral("None") : QStringLiteral("All"));
    } else if (key == "phase") {
      labels << name.left(1).toUpper() + name.mid(1);
    } else if (key == "quantity") {
      labels << QString::fromStdString(fields.quantity(id)->label);
    } else if (key == "body") {
      const bool ofTap = itemById(project.emitters, id) != project.emitters.end();
      labels << ownerLabel(project, {ofTap ? Owner::Emitter : Owner::Body, id, ""});
    } else if (key == "wall" || key == "material") {
      labels << ownerLabel(project, {key == "wall" ? Owner::Wall : Owner::Material, id, ""});
    } else {
      return {};  // the names say it
    }
  }
  return labels;
}

/// Which edges of a sheet, or ends of a rope, are held: as it stands in the scene, with the axis.
QStringList heldLabels(const SolidShape& solid) {
  const SolidForm form(solid);
  if (form.kind() != SolidForm::Kind::Sheet)
    return {QStringLiteral("Nowhere"), QStringLiteral("Its first point"), QStringLiteral("Both ends")};
  const Vector3 way = -form.axes().col(2);  // to the edge that is held first
  Eigen::Index axis = 0;
  way.cwiseAbs().maxCoeff(&axis);
  const QString name = QString(QLatin1Char("xyz"[axis]));
  const QString side = (way[axis] < 0 ? QString(QChar(0x2212)) : QStringLiteral("+")) + name;
  if (axis != 1)
    return {QStringLiteral("Nowhere"), QStringLiteral("Edge at %1").arg(side),
            QStringLiteral("Both edges across %1").arg(name)};
  return {QStringLiteral("Nowhere"),
          (way[axis] > 0 ? QStringLiteral("Top edge, %1") : QStringLiteral("Bottom edge, %1")).arg(side),
          QStringLiteral("Top and bottom edges")};
}

}  // namespace

QStringList choiceLabels(const Project& project, const PluginRegistry* plugins, const Address& address,
                         const api::ParameterDeclaration& declaration) {
  if (address.owner == Owner::Probe) return probeChoiceLabels(project, plugins, address.key, declaration);
  if (address.owner == Owner::Shape && address.key == "held") {
    const auto body = itemById(project.bodies, address.id);
    const auto* solid = body == project.bodies.end() ? nullptr : std::get_if<SolidShape>(&body->shape);
    return solid ? heldLabels(*solid) : QStringList();
  }
  const bool ofPlugins = (address.owner == Owner::Scene && address.key == "thermal_model") ||
                         (address.owner == Owner::Body && address.key == kStructureKey);
  const bool ofMaterials = address.owner == Owner::Body && address.key == kBodyMaterialKey;
  if (!ofPlugins && !ofMaterials) return {};
  QStringList labels;
  for (const QString& name : QString::fromUtf8(declaration.choices).split(QLatin1Char('|'))) {
    const std::string id = name.toStdString();
    if (ofMaterials) {
      labels << ownerLabel(project, {Owner::Material, id, ""});
    } else {
      labels << (id == kNoStructure ? QStringLiteral("None") : pluginLabel(plugins, id));
    }
  }
  return labels;
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
