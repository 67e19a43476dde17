// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <string>

namespace ps {

class Document;

/// The scene's material that is an installed one, with whatever values; nullptr where there is none. No mixture is one.
const SceneMaterial* installedIn(const Project& project, const std::string& base);

/// Brings a material with values of its own into the scene, beside those that are there; its id gets a number when it
/// is taken. One undo step. Returns the id.
std::string addPreset(Document& document, SceneMaterial preset);

}  // namespace ps
