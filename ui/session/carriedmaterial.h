// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

class QMimeData;

namespace ps {

class Document;
struct SceneMaterial;

/// What a material is dragged as: one of the scene, also as that of a body, by its id, one that can be added by its
/// base, a preset as a project that holds it.
inline constexpr const char *kMaterialMime = "application/x-phasesketch-material",
                            *kInstalledMime = "application/x-phasesketch-installed-material",
                            *kPresetMime = "application/x-phasesketch-preset";

/// Whether something that is dragged is a material.
bool carriesMaterial(const QMimeData& data);
/// A preset as it is dragged.
void carryPreset(QMimeData& data, const SceneMaterial& preset);
/// A body becomes what is dropped on it, which comes into the scene where it is not there yet: one undo step. False
/// where there is no such body or material, and where the body is locked.
bool giveMaterial(Document& document, const std::string& body, const QMimeData& data);

}  // namespace ps
