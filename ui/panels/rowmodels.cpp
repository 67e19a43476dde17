// SPDX-License-Identifier: Apache-2.0
#include "ui/panels/rowmodels.h"

#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/rules.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"

#include <algorithm>

namespace ps {
namespace {

QString sourceText(const Provenance& provenance) {
  const char* grade = provenance.grade == 'A'   ? "reference data, grade A"
                      : provenance.grade == 'B' ? "handbook data, grade B"
                                                : "typical value, grade C";
  const QString from = QString::fromStdString(provenance.source);
  return (from.isEmpty() ? from : from + QStringLiteral("; ")) + QLatin1String(grade);
}

const SceneMaterial* materialAt(const Document& document, const Address& address) {
  if (address.owner != Owner::Material) return nullptr;
  const std::vector<SceneMaterial>& all = document.project().materials;
  const auto found = std::find_if(all.begin(), all.end(), [&](const SceneMaterial& m) { return m.id == address.id; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

QString idleText(const Document& document, const Address& address) {
  const PluginRegistry* plugins = document.plugins();
  const SceneMaterial* material = materialAt(document, address);
  if (material && plugins && !plugins->material(material->base))
    return QStringLiteral("The material's plugin is not installed. Values are kept as they stand in the file.");
  return QString::fromStdString(idleReason(document.project(), document.plugins(), address));
}

void addRules(RowModel& row, const Document& document, const Address& address) {
  row.rules.clear();
  for (const std::string& rule : rulesOf(document.project(), document.plugins(), address))
    row.rules << QString::fromStdString(rule);
  row.disabledReason = idleText(document, address);
}

bool hasRow(const Document& document, const Address& address) {
  const bool there = address.owner == Owner::Probe
                         ? document.probe(address.id) != nullptr
                         : address.owner == Owner::Scene || findSet(document.project(), address);
  return there && document.declaration(address);
}

std::optional<RowModel> rowModelOf(const Document& document, const Address& address) {
  if (!hasRow(document, address)) return std::nullopt;
  RowModel row;
  row.key = QString::fromStdString(address.text());
  row.declaration = *document.declaration(address);
  row.value = document.value(address);
  row.defaultValue = document.defaultValue(address);
  row.choiceLabels = choiceLabels(document.project(), document.plugins(), address, row.declaration);
  addRules(row, document, address);
  return row;
}

QString sourceOf(const Document& document, const std::string& material, const char* key) {
  const SceneMaterial* owner = materialAt(document, {Owner::Material, material, key});
  const PluginRegistry* plugins = document.plugins();
  const Material* installed = owner && plugins ? plugins->material(owner->base) : nullptr;
  if (!installed) return {};
  const auto from = installed->provenance.find(key);
  return from == installed->provenance.end() ? QString() : sourceText(from->second);
}

QString gradeText(const PluginRegistry* plugins, const std::string& base) {
  const Material* material = plugins ? plugins->material(base) : nullptr;
  if (!material || material->provenance.empty()) return {};
  char worst = 'A';
  for (const auto& [key, provenance] : material->provenance) worst = std::max(worst, provenance.grade);
  if (worst == 'A') return QStringLiteral("Reference data, grade A");
  return worst == 'B' ? QStringLiteral("Handbook data, grade B")
                      : QStringLiteral("Reference, handbook and typical data");
}

}  // namespace ps
