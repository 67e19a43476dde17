// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/becoming.h"

#include "core/plugin_host/registry.h"
#include "core/simulation/declared.h"
#include "ui/document/declared.h"
#include "ui/theme/units.h"

#include <phasesketch/thin.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <variant>

namespace ps {
namespace {

/// The choices in the order of kBecomings.
enum Choice : size_t { kOfItself, kRigid, kBonded, kSoft, kCloth, kRope };

std::string_view nameOf(Choice choice) {
  std::string_view rest = kBecomings;
  for (size_t before = 0; before < choice; ++before) rest.remove_prefix(rest.find('|') + 1);
  return rest.substr(0, rest.find('|'));
}

/// A property at `temperature` K; nullopt of what has none.
std::optional<double> propertyOf(const Project& project, const PluginRegistry& plugins, const std::string& material,
                                 const char* key, double temperature) {
  const Value value = valueAt(project, &plugins, {Owner::Material, material, key});
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* response = std::get_if<Response>(&value)) return response->at(temperature);
  return std::nullopt;
}

bool isSolid(const Project& project, const PluginRegistry& plugins, const std::string& material, double temperature) {
  const auto melting = propertyOf(project, plugins, material, "melting_temperature", temperature);
  return melting && temperature < *melting;
}

/// K, where it melts or turns to vapour; 0 for what has no melting point, which is never solid of itself.
double solidUntil(const Project& project, const PluginRegistry& plugins, const std::string& material,
                  double temperature) {
  const auto point = [&](const char* key) {
    return propertyOf(project, plugins, material, key, temperature).value_or(0);
  };
  const double melting = point("melting_temperature"), boiling = point("boiling_temperature");
  return melting > 0 && boiling > 0 ? std::min(melting, boiling) : std::max(melting, 0.0);
}

/// Whether a plugin holds bodies as this wants them.
bool makes(const PluginRegistry& plugins, const std::string& id, const std::string& becoming) {
  const api::ConstraintPlugin* plugin = plugins.constraint(id);
  if (!plugin) return false;
  if (becoming == nameOf(kBonded)) return plugin->extension(api::kHoldsFrozen) != nullptr;
  if (becoming == nameOf(kCloth)) return plugin->extension(api::kHoldsSheets) != nullptr;
  if (becoming == nameOf(kRope)) return plugin->extension(api::kHoldsLines) != nullptr;
  const auto form = plugins.constraintForm(id);
  const auto* group = form ? std::get_if<const api::GroupPlugin*>(&*form) : nullptr;
  api::GroupTraits traits;
  if (!group || !(*group)->traits(&traits) || traits.thin != 0) return false;
  return becoming == nameOf(traits.rigid != 0 ? kRigid : kSoft);
}

bool needsStructure(const std::string& becoming) {
  return std::ranges::any_of(std::array{kRigid, kBonded, kSoft, kCloth, kRope},
                             [&](Choice choice) { return becoming == nameOf(choice); });
}

/// The first by id; "" where none is installed.
std::string structureFor(const PluginRegistry& plugins, const std::string& becoming) {
  if (becoming == nameOf(kBonded)) return frozenStructure(plugins);
  const std::vector<std::string> ids = plugins.ids(PluginKind::Constraint);
  const auto found =
      std::find_if(ids.begin(), ids.end(), [&](const std::string& id) { return makes(plugins, id, becoming); });
  return found == ids.end() ? std::string() : *found;
}

/// Whether sheets or ropes are made of it.
bool isForThin(const Project& project, const PluginRegistry& plugins, const std::string& material) {
  const auto own = std::find_if(project.materials.begin(), project.materials.end(),
                                [&](const SceneMaterial& one) { return one.id == material; });
  if (own == project.materials.end()) return false;
  for (const std::string& id : plugins.ids(PluginKind::Constraint)) {
    const api::ConstraintPlugin* plugin = plugins.constraint(id);
    for (const char* capability : {api::kHoldsSheets, api::kHoldsLines}) {
      const auto* thin = static_cast<const api::ThinMatter*>(plugin ? plugin->extension(capability) : nullptr);
      if (thin && thin->material && own->base == thin->material) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<std::pair<std::string, QString>> becomings() {
  const QString labels[] = {QStringLiteral("As the material is"),
                            QStringLiteral("Rigid"),
                            QStringLiteral("Bonded"),
                            QStringLiteral("Soft"),
                            QStringLiteral("Cloth"),
                            QStringLiteral("Rope"),
                            QStringLiteral("Loose grains"),
                            QStringLiteral("Liquid"),
                            QStringLiteral("Gas"),
                            QStringLiteral("Fixed ground")};
  std::vector<std::pair<std::string, QString>> all;
  for (size_t k = 0; k < std::size(labels); ++k) all.emplace_back(nameOf(static_cast<Choice>(k)), labels[k]);
  return all;
}

std::string ownBecoming(const Project& project, const PluginRegistry& plugins, const std::string& material,
                        double temperature) {
  if (!isSolid(project, plugins, material, temperature)) return "loose";
  const double stiffness = propertyOf(project, plugins, material, "youngs_modulus", temperature).value_or(0);
  const bool staysSolid = isSolid(project, plugins, material, temperature + kStandsBelowMelting);
  const bool stands = stiffness >= kStandsFrom && staysSolid && !isForThin(project, plugins, material);
  const std::string rigid(nameOf(kRigid));
  return stands && !structureFor(plugins, rigid).empty() ? rigid : std::string(nameOf(kBonded));
}

QString whyNotBecome(const Project& project, const PluginRegistry& plugins, const std::string& material,
                     const std::string& becoming) {
  if (becoming == "gas" && propertyOf(project, plugins, material, "boiling_temperature", 0).value_or(0) <= 0)
    return QStringLiteral(
               "“%1” never boils, so that it cannot become gas. Choose another row under “Becomes”, or "
               "another material.")
        .arg(ownerLabel(project, {Owner::Material, material, ""}));
  if (!needsStructure(becoming) || !structureFor(plugins, becoming).empty()) return {};
  return QStringLiteral("No plugin is installed that makes what is drawn %1. Choose another row under “Becomes”.")
      .arg((becoming == nameOf(kRope) ? QStringLiteral("a ") : QString()) + QString::fromStdString(becoming));
}

QString whatFlows(const Project& project, const PluginRegistry& plugins, const std::string& material,
                  const std::string& becoming, double temperature) {
  const double until = solidUntil(project, plugins, material, temperature);
  if (!needsStructure(becoming) || temperature < until) return {};
  const auto rows = becomings();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& one) { return one.first == becoming; });
  const QString name = ownerLabel(project, {Owner::Material, material, ""});
  if (until <= 0)
    return QStringLiteral(
               "“%1” has no melting point and flows, however slowly, and “%2” holds together what is solid. Choose "
               "another material, or another row under “Becomes”.")
        .arg(name, row->second);
  return QStringLiteral(
             "“%1” is solid below %2, and “%3” holds together what is solid. Choose a lower temperature than %4, or "
             "another row under “Becomes”.")
      .arg(name, temperatureText(until, 0), row->second, temperatureText(temperature, 0));
}

void become(Body& body, const std::string& becoming, const Project& project, const PluginRegistry& plugins,
            double temperature) {
  const std::string wanted =
      becoming == kBecomesOfItself ? ownBecoming(project, plugins, body.material, temperature) : becoming;
  if (wanted == "fixed") {
    body.parameters.values["fixed"] = true;
  } else if (wanted == "liquid" || wanted == "gas") {
    body.parameters.values["phase"] = wanted;
  } else if (needsStructure(wanted)) {
    const std::string structure = structureFor(plugins, wanted);
    if (!structure.empty()) body.constraints.push_back({structure, {}, {}});
  }
}

bool hasBecome(const Body& body, const std::string& becoming, const Project& project, const PluginRegistry& plugins,
               double temperature) {
  if (becoming == kBecomesOfItself) return true;
  const bool fixed = toggleOf(body.parameters, bodyParameters(), "fixed");
  if (fixed || becoming == "fixed") return fixed && becoming == "fixed";
  if (needsStructure(becoming)) return makes(plugins, structureOf(body, &plugins), becoming);
  if (structureOf(body, &plugins) != kNoStructure) return false;
  const std::string phase = choiceOf(body.parameters, bodyParameters(), "phase");
  if (becoming != "loose" && phase == becoming) return true;
  if (phase != "automatic") return false;
  return becoming == "loose" || (becoming == "liquid" && !isSolid(project, plugins, body.material, temperature));
}

}  // namespace ps
