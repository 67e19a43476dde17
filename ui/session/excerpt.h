// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "ui/document/placement.h"
#include "ui/session/selection.h"

#include <QtCore/QString>

#include <string>
#include <vector>

namespace ps {

class PluginRegistry;

/// What is copied: a project of some of the things of another, with the materials that they need, their tracks, and the
/// groups that they are in.
Project excerptOf(const Project& project, const std::vector<SelectedItem>& items);
/// The same of materials.
Project excerptOfMaterials(const Project& project, const std::vector<std::string>& materials);
/// Whether there is anything in it.
bool isEmpty(const Project& excerpt);
/// As the clipboard has it: a project file.
std::string textOf(Project excerpt);
/// Of a project file. Throws InputError that says what is wrong.
Project excerptIn(const std::string& text, const PluginRegistry& plugins);
std::vector<SelectedItem> itemsOf(const Placement& things);
/// Those of an excerpt, as they are there.
Placement thingsOf(const Project& excerpt);

}  // namespace ps
