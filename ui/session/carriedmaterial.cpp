// SPDX-License-Identifier: Apache-2.0
#include "ui/session/carriedmaterial.h"

#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/presets.h"
#include "ui/session/selection.h"

#include <QtCore/QMimeData>

#include <algorithm>
#include <optional>

namespace ps {
namespace {

std::string textOf(const QMimeData& data, const char* format) { return data.data(QLatin1String(format)).toStdString(); }

/// Nothing where it cannot be read: another program may drag what it likes under our names.
std::optional<SceneMaterial> presetOf(const Document& document, const QMimeData& data) {
  if (!document.plugins()) return std::nullopt;
  try {
    const auto materials = readProject(textOf(data, kPresetMime), "dragged", *document.plugins()).project.materials;
    if (materials.size() == 1) return materials.front();
  } catch (const std::exception&) {
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

bool carriesMaterial(const QMimeData& data) {
  return data.hasFormat(QLatin1String(kMaterialMime)) || data.hasFormat(QLatin1String(kInstalledMime)) ||
         data.hasFormat(QLatin1String(kPresetMime));
}

void carryPreset(QMimeData& data, const SceneMaterial& preset) {
  Project project;
  project.title = preset.label;
  project.materials.push_back(preset);
  if (preset.id.empty()) project.materials.back().id = preset.base;  // no file holds one without
  data.setData(QLatin1String(kPresetMime), QByteArray::fromStdString(writeProject(project)));
}

QString whyNoMaterial(const Document& document, const std::string& body) {
  if (const Emitter* tap = document.emitter(body))
    return QStringLiteral("What “%1” pours stays what it is. Drop it on a body.").arg(nameOf(*tap));
  const Body* target = document.body(body);
  if (!target) return QStringLiteral("Drop it on a body.");
  return target->locked ? QStringLiteral("“%1” is locked. Unlock it first.").arg(nameOf(*target)) : QString();
}

std::vector<std::string> takersOf(const Document& document, const Selection& selection, const std::string& body) {
  if (!whyNoMaterial(document, body).isEmpty()) return {};
  if (!selection.has(OutlineKind::Body, body)) return {body};
  std::vector<std::string> all = selection.bodies();
  std::erase_if(all, [&](const std::string& each) { return !whyNoMaterial(document, each).isEmpty(); });
  return all;
}

bool giveMaterial(Document& document, std::vector<std::string> bodies, const QMimeData& data) {
  std::erase_if(bodies, [&](const std::string& each) { return !whyNoMaterial(document, each).isEmpty(); });
  if (bodies.empty()) return false;
  const auto& materials = document.project().materials;
  const std::string id = textOf(data, kMaterialMime), base = textOf(data, kInstalledMime);
  std::string material;
  if (!id.empty()) {
    const bool there =
        std::any_of(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == id; });
    if (there) material = id;
  } else if (const SceneMaterial* present = installedIn(document.project(), base)) {
    material = present->id;
  }
  const bool installed = !base.empty() && document.plugins() && document.plugins()->material(base);
  const auto preset = id.empty() && base.empty() ? presetOf(document, data) : std::nullopt;
  if (material.empty() && (!id.empty() || !(installed || preset))) return false;
  std::erase_if(bodies, [&](const std::string& each) { return document.body(each)->material == material; });
  if (bodies.empty()) return true;  // no step that does nothing
  document.undoStack().beginMacro(bodies.size() == 1
                                      ? QStringLiteral("material of %1").arg(nameOf(*document.body(bodies[0])))
                                      : QStringLiteral("material of %1 bodies").arg(bodies.size()));
  if (material.empty()) material = preset ? addPreset(document, *preset) : document.addMaterial(base);
  for (const std::string& body : bodies) document.setBodyMaterial(body, material);
  document.undoStack().endMacro();
  return true;
}

}  // namespace ps
