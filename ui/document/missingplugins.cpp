// SPDX-License-Identifier: Apache-2.0
#include "ui/document/missingplugins.h"

#include "core/scene/shownname.h"
#include "core/simulation/declared.h"
#include "ui/document/declared.h"

#include <QtCore/QStringList>

#include <algorithm>

namespace ps {
namespace {

constexpr qsizetype kMostNamed = 3;

/// "“Block”, “Spoon” and 4 more"
QString listOf(const QStringList& names) {
  QStringList quoted;
  for (const QString& name : names.mid(0, kMostNamed)) quoted << QStringLiteral("“%1”").arg(name);
  const qsizetype more = names.size() - quoted.size();
  if (more > 0) return quoted.join(QStringLiteral(", ")) + QStringLiteral(" and %1 more").arg(more);
  const QString last = quoted.takeLast();
  return quoted.isEmpty() ? last : quoted.join(QStringLiteral(", ")) + QStringLiteral(" and ") + last;
}

MissingPlugin& entryOf(std::vector<MissingPlugin>& list, const std::string& id, PluginKind kind) {
  const auto known =
      std::find_if(list.begin(), list.end(), [&](const MissingPlugin& m) { return m.id == id && m.kind == kind; });
  if (known != list.end()) return *known;
  return list.emplace_back(MissingPlugin{id, kind});
}

/// Why it is not there, after "which ": it may be refused or in quarantine.
QString whyNot(const std::string& id, const PluginRegistry& plugins) {
  for (const PluginInfo& info : plugins.plugins()) {
    if (info.id == id && info.state == PluginInfo::State::Quarantined) return QStringLiteral("is in quarantine");
    if (info.id == id && !info.problem.empty()) return QStringLiteral("cannot be used");
  }
  return QStringLiteral("is not installed");
}

}  // namespace

std::vector<MissingPlugin> missingPlugins(const Project& project, const PluginRegistry& plugins) {
  std::vector<MissingPlugin> list;
  for (const SceneMaterial& material : project.materials) {
    if (plugins.material(material.base)) continue;
    MissingPlugin& missing = list.emplace_back(MissingPlugin{material.base, PluginKind::Material, material.id});
    for (const Body& body : project.bodies) {
      if (body.material == material.id) missing.rows.push_back({Owner::Body, body.id, kBodyMaterialKey});
    }
  }
  for (const Body& body : project.bodies) {
    for (const BodyConstraint& constraint : body.constraints) {
      if (plugins.constraint(constraint.plugin)) continue;
      const bool structure = structureOf(body, &plugins) == constraint.plugin;
      entryOf(list, constraint.plugin, PluginKind::Constraint)
          .rows.push_back({Owner::Body, body.id, structure ? kStructureKey : kNeighbourKey + constraint.plugin});
    }
  }
  const std::string& thermal = project.solver.thermalModel;
  if (!thermal.empty() && !plugins.thermal(thermal))
    entryOf(list, thermal, PluginKind::Thermal).rows.push_back({Owner::Scene, "", "thermal_model"});
  for (const UsedHeatSource& source : project.solver.heatSources) {
    if (!plugins.heatSource(source.plugin))
      entryOf(list, source.plugin, PluginKind::HeatSource)
          .rows.push_back({Owner::Scene, "", kHeatSourceKey + source.plugin});
  }
  return list;
}

QString missingText(const MissingPlugin& missing, const Project& project, const PluginRegistry& plugins) {
  const QString plugin =
      QStringLiteral("the plugin “%1”, which %2.").arg(QString::fromStdString(missing.id), whyNot(missing.id, plugins));
  QStringList owners;
  for (const Address& row : missing.rows) owners << ownerLabel(project, row);
  const QString still = owners.isEmpty() ? QString()
                                         : QStringLiteral(" %1 %2 still meanwhile.")
                                               .arg(listOf(owners), owners.size() == 1 ? QStringLiteral("stands")
                                                                                       : QStringLiteral("stand"));
  const QString kept = QStringLiteral(" All values are kept.");
  switch (missing.kind) {
    case PluginKind::Material: {
      const auto material = std::find_if(project.materials.begin(), project.materials.end(),
                                         [&](const SceneMaterial& m) { return m.id == missing.material; });
      const QString name =
          QString::fromStdString(material == project.materials.end() ? missing.material : shownName(*material));
      return QStringLiteral("The material “%1” needs ").arg(name) + plugin + still + kept;
    }
    case PluginKind::Constraint:
      return QStringLiteral("What holds %1 together needs ").arg(listOf(owners)) + plugin + still + kept;
    case PluginKind::Thermal:
      return QStringLiteral("The heat of this scene needs ") + plugin + QStringLiteral(" Nothing warms or cools.") +
             kept;
    default:
      return QStringLiteral("A source of heat needs ") + plugin + QStringLiteral(" It gives nothing.") + kept;
  }
}

}  // namespace ps
