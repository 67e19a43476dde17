// SPDX-License-Identifier: Apache-2.0
// The page Material of the inspector: one, or several that are edited together.
#include "core/matter/material.h"
#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/panels/inspector.h"
#include "ui/panels/keptrows.h"
#include "ui/panels/rowmodels.h"
#include "ui/panels/wayout.h"
#include "ui/session/session.h"
#include "ui/session/swatches.h"
#include "ui/session/wording.h"
#include "ui/theme/numbers.h"
#include "ui/theme/units.h"

#include <algorithm>
#include <utility>

namespace ps {
namespace {

/// The material that a row belongs to; "" for other rows.
std::string materialOf(const QString& key) {
  const auto address = Address::parse(key.toStdString());
  return address && address->owner == Owner::Material ? address->id : std::string();
}

}  // namespace

void Inspector::setMaterials(const std::vector<std::string>& ids) {
  std::vector<Address> materials;
  for (const std::string& id : ids) materials.push_back({Owner::Material, id, ""});
  if (materials == m_materials) return;
  m_materials = std::move(materials);
  m_differing.clear();
  rebuildMaterial();
}

void Inspector::rebuildMaterial() {
  const Project& project = m_document.project();
  const auto found = std::find_if(project.materials.begin(), project.materials.end(),
                                  [&](const SceneMaterial& m) { return m.id == material(); });
  const auto material =
      found == project.materials.end() && !project.materials.empty() ? project.materials.begin() : found;
  std::vector<RowModel> rows;
  if (material == project.materials.end()) {
    m_material->setHeader({}, {});
    m_material->setHeaderNote({});
    m_material->setModel({});
    return;
  }
  std::erase_if(m_materials, [&](const Address& one) {
    return std::none_of(project.materials.begin(), project.materials.end(),
                        [&](const SceneMaterial& each) { return each.id == one.id; });
  });
  if (this->material() != material->id) m_materials = {{Owner::Material, material->id, ""}};
  const PluginRegistry* plugins = m_document.plugins();
  showMaterialHeader();
  const Address any{Owner::Material, material->id, ""};
  addRows(rows, any, propertyCatalogue(), {}, materialDefaults(project, plugins, material->id));
  if (const api::MaterialPlugin* plugin = plugins ? plugins->materialPlugin(material->base) : nullptr) {
    addRows(rows, any, plugins->parameters(material->base), QString::fromUtf8(plugin->label()));
  }
  if (plugins && !plugins->material(material->base)) {
    for (RowModel& row : keptRows(material->parameters, material->unknown, "", any, material->base))
      rows.push_back(std::move(row));
  }
  for (const SceneMaterial& other : project.materials) {
    if (auto row = rowModelOf(m_document, {Owner::Material, material->id, kAdheresKey + other.id}))
      rows.push_back(std::move(*row));
  }
  addPinned(rows);
  for (RowModel& row : rows) {
    const std::string owner = materialOf(row.key);
    row.temperature = temperatureOf(owner);
    row.source = sourceOf(m_document, owner, row.declaration.key);
  }
  shareRows(rows, m_materials);
  m_material->setModel(std::move(rows));
  m_notes.show();
  showTracks();
}

void Inspector::showMaterialHeader() {
  const Project& project = m_document.project();
  m_material->setHeaderNote({});
  if (m_materials.size() > 1) {
    QStringList names;
    for (const Address& one : m_materials) names << ownerLabel(project, one);
    m_material->setHeader(countText(m_materials.size(), QStringLiteral("material"), QStringLiteral("materials")),
                          names.join(QStringLiteral(", ")));
    return;
  }
  const auto material = std::find_if(project.materials.begin(), project.materials.end(),
                                     [&](const SceneMaterial& m) { return m.id == this->material(); });
  if (material == project.materials.end()) return;
  const PluginRegistry* plugins = m_document.plugins();
  QStringList bodies;
  for (const Body& body : project.bodies) {
    if (body.material == material->id) bodies << nameOf(body);
  }
  for (const Emitter& emitter : project.emitters) {
    if (emitter.material == material->id) bodies << ownerLabel(project, {Owner::Emitter, emitter.id, "speed"});
  }
  m_grade = gradeText(plugins, material->base);
  const bool missing = plugins && !plugins->material(material->base);
  const SwatchPainter swatch = missing ? SwatchPainter(paintPlaceholder)
                                       : m_session.swatches().painterOf(swatchOf(project, plugins, material->id));
  m_material->setHeader(QString::fromStdString(shownName(*material)), bodies.join(QStringLiteral(", ")),
                        materialDetail(), swatch);
  if (!missing) return;
  for (const MissingPlugin& each : missingPlugins(project, *plugins)) {
    if (each.material == material->id) m_material->setHeaderNote(wayout::note(each, m_document));
  }
}

QString Inspector::materialDetail() const {
  const QString at = QStringLiteral("At ") + temperatureText(temperatureOf(material()), 1);
  return m_grade.isEmpty() ? at : at + QStringLiteral(" · ") + m_grade;
}

double Inspector::temperatureOf(const std::string& material) const {
  const auto mean = m_mean.find(material);
  return mean == m_mean.end() ? m_sceneMean : mean->second;
}

void Inspector::showTemperatures(const Snapshot& snapshot) {
  // The engine keeps a material that the document has lost until the next reset: places differ, ids do not.
  const std::vector<std::string>& ids = snapshot.materialIds;
  std::vector<double> sums(ids.size()), counts(ids.size());
  for (size_t i = 0; i < snapshot.material.size(); ++i) {
    const size_t material = snapshot.material[i];
    if (material >= sums.size()) continue;  // no snapshot of an engine
    sums[material] += static_cast<double>(snapshot.temperature[i]);
    ++counts[material];
  }
  m_sceneMean = snapshot.stats.temperatureMean > 0 ? snapshot.stats.temperatureMean : ambientTemperature();
  m_mean.clear();
  for (size_t k = 0; k < ids.size(); ++k) {
    if (counts[k] > 0) m_mean[ids[k]] = sums[k] / counts[k];
  }
  for (ParameterRow* row : m_material->rows()) row->setTemperature(temperatureOf(materialOf(row->key())));
  if (m_materials.size() == 1) m_material->setHeaderDetail(materialDetail());
}

/// A material plugin's own parameter changed: every property may have another default, and another value where none is
/// set.
void Inspector::refreshProperties(const std::string& material) {
  const ParameterSet defaults = materialDefaults(m_document.project(), m_document.plugins(), material);
  const ParameterSet* own = findSet(m_document.project(), {Owner::Material, material, propertyCatalogue()[0].key});
  if (!own) return;
  for (const RowModel& row : rowModels(propertyCatalogue(), *own, defaults,
                                       QStringLiteral("material/%1/").arg(QString::fromStdString(material)))) {
    m_material->setDefaultValue(row.key, row.defaultValue);
    m_material->setValue(row.key, row.value);
    refreshMixed(*Address::parse(row.key.toStdString()));
  }
}

}  // namespace ps
