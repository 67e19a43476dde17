// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

#include <string>
#include <vector>

class QMimeData;

namespace ps {

class Document;
class Selection;
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
/// Why a body does not take one, as a sentence; "" where it does.
QString whyNoMaterial(const Document& document, const std::string& body);
/// Who takes a material that is dropped on a body: all that are selected, where it is one of them. Those that take none
/// are left out.
std::vector<std::string> takersOf(const Document& document, const Selection& selection, const std::string& body);
/// Bodies become what is dropped on them, which comes into the scene where it is not there yet: one undo step. False
/// where there is no such material, or nobody to take it.
bool giveMaterial(Document& document, std::vector<std::string> bodies, const QMimeData& data);

}  // namespace ps
