// SPDX-License-Identifier: Apache-2.0
// Materials of the scene that are mixtures of two others. What comes of a mixture is a material like any other, whose
// properties are written out, so that nothing that runs needs to know.
#pragma once
#include "core/matter/material.h"
#include "core/scene/project.h"

#include <string>

namespace ps {

class PluginRegistry;

/// A material as a part, with what it states.
Mixture::Part partOf(const Material& material);
/// The part as a material again.
Material materialOf(const Mixture::Part& part);
/// All properties of the mixture; its label says what it is made of. See whyNot() for what makes none.
Material materialOf(const Mixture& mixture);
/// "" or why there is no such mixture, as a sentence.
std::string whyNot(const Mixture& mixture);
/// "70 % Tin and 30 % Lead by mass".
std::string mixtureText(const Mixture& mixture);

/// A whole material as one of a scene: the standard one with all in which it differs from that. The caller names it.
SceneMaterial writtenOut(const Material& whole, const PluginRegistry& plugins);
/// The mixture written out, and what it was made of. Throws InputError with whyNot().
SceneMaterial mixedMaterial(const Mixture& mixture, const PluginRegistry& plugins);

/// The same material with another share. Values that somebody has changed since it was mixed stay as they are. Throws
/// InputError where it is no mixture, or with whyNot().
SceneMaterial withShare(const SceneMaterial& material, double share, const PluginRegistry& plugins);

}  // namespace ps
