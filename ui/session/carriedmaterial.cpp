// SPDX-License-Identifier: Apache-2.0
#include "ui/session/carriedmaterial.h"

#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/presets.h"

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
  data.setData(QLatin1String(kPresetMime), QByteArray::fromStdString(writeProject(project)));
}

bool giveMaterial(Document& document, const std::string& body, const QMimeData& data) {
  const Body* target = document.body(body);
  if (!target || target->locked) return false;
  if (const std::string id = textOf(data, kMaterialMime); !id.empty()) {
    const auto& materials = document.project().materials;
    if (std::none_of(materials.begin(), materials.end(), [&](const SceneMaterial& m) { return m.id == id; }))
      return false;
    document.setBodyMaterial(body, id);
    return true;
  }
  const std::string base = textOf(data, kInstalledMime);
  const std::optional<SceneMaterial> preset = base.empty() ? presetOf(document, data) : std::nullopt;
  const bool installed = !base.empty() && document.plugins() && document.plugins()->material(base);
  if (!installed && !preset) return false;
  document.undoStack().beginMacro(QStringLiteral("material of %1").arg(nameOf(*target)));
  document.setBodyMaterial(body, installed ? document.addMaterial(base) : addPreset(document, *preset));
  document.undoStack().endMacro();
  return true;
}

}  // namespace ps
