// SPDX-License-Identifier: Apache-2.0
// Materials of the scene that are mixtures of two others. What comes of a mixture is a material like any other, whose
// properties are written out, so that nothing that runs needs to know; beside them it keeps what it was made of, as a
// part of its file ("mixture") that only those read who show it or change the share.
#pragma once
#include "core/matter/material.h"
#include "core/scene/project.h"

#include <optional>
#include <string>
#include <vector>

namespace ps {

class PluginRegistry;

/// What a material was mixed from, by the rules of core/matter/mixture.h. The parts are whole, with every value that
/// they had: the share can be changed where they are not installed, or have left the scene.
struct Mixture {
  struct Part {
    std::string label;
    ParameterSet properties{};             ///< keys of the property catalogue
    std::vector<std::string> adheresTo{};  ///< see Material::adheresTo
    Unknown unknown{};
  };
  double share = 0.5;  ///< of the second part, by mass: 0 to 1
  Part first{}, second{};
  Unknown unknown{};
};

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

/// Whether a material of the scene was mixed: it is then no installed one, whatever it is written beside.
bool isMixture(const SceneMaterial& material);
/// What a material of the scene was mixed from, where it was.
std::optional<Mixture> mixtureOf(const SceneMaterial& material, const PluginRegistry& plugins);

/// The mixture as a material of a scene: the standard one with all in which the mixture differs from it, and what it
/// was made of. The caller names it. Throws InputError with whyNot().
SceneMaterial mixedMaterial(const Mixture& mixture, const PluginRegistry& plugins);

/// The same material with another share. Values that somebody has changed since it was mixed stay as they are. Throws
/// InputError where it is no mixture, or with whyNot().
SceneMaterial withShare(const SceneMaterial& material, double share, const PluginRegistry& plugins);

}  // namespace ps
