// SPDX-License-Identifier: Apache-2.0
#include "ui/document/presets.h"

#include "ui/document/commands.h"
#include "ui/document/document.h"

#include <algorithm>

namespace ps {

const SceneMaterial* installedIn(const Project& project, const std::string& base) {
  const auto found = std::find_if(project.materials.begin(), project.materials.end(),
                                  [&](const SceneMaterial& m) { return m.base == base && !m.mixture; });
  return found == project.materials.end() ? nullptr : &*found;
}

std::string addPreset(Document& document, SceneMaterial preset) {
  const std::vector<SceneMaterial>& before = document.project().materials;
  const auto taken = [&](const std::string& id) {
    return std::any_of(before.begin(), before.end(), [&](const SceneMaterial& m) { return m.id == id; });
  };
  const std::string stem = preset.id.empty() ? preset.base : preset.id;
  preset.id = stem;
  for (int n = 2; taken(preset.id); ++n) preset.id = stem + "-" + std::to_string(n);
  const std::string id = preset.id;
  const QString title = QStringLiteral("adding %1").arg(QString::fromStdString(preset.label));
  std::vector<SceneMaterial> after = before;
  after.push_back(std::move(preset));
  document.undoStack().push(new MaterialsCommand(document, before, std::move(after), title));
  return id;
}

}  // namespace ps
