// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <QtCore/QString>

#include <string>
#include <utility>
#include <vector>

namespace ps {

class PluginRegistry;

/// What the matter of a stroke becomes, a choice of the brush's row "Becomes". What is rigid, bonded, cloth, ... is
/// held so by the first plugin that can, whatever its name.
inline constexpr const char* kBecomesOfItself = "automatic";
inline constexpr const char* kBecomings = "automatic|rigid|bonded|soft|cloth|rope|loose|liquid|gas|fixed";

/// Those of kBecomings, and what the editor calls them.
std::vector<std::pair<std::string, QString>> becomings();

/// Pa, and K below its melting point: from where on matter that is drawn stands as a rigid body of itself. What is
/// less stiff bends as it should; what melts sooner is there to be melted and broken.
inline constexpr double kStandsFrom = 1e8, kStandsBelowMelting = 100;

/// What matter of a scene's material becomes at `temperature` K where nobody says: "rigid", "bonded", or "loose" where
/// it is no solid. Bonded too is what cloth and ropes are made of.
std::string ownBecoming(const Project& project, const PluginRegistry& plugins, const std::string& material,
                        double temperature);
/// "" or why no body of a scene's material can become that: no plugin is installed that makes it, or it never boils.
QString whyNotBecome(const Project& project, const PluginRegistry& plugins, const std::string& material,
                     const std::string& becoming);
/// "" or why matter of a scene's material at `temperature` K flows though it is to be held together.
QString whatFlows(const Project& project, const PluginRegistry& plugins, const std::string& material,
                  const std::string& becoming, double temperature);
/// Sets what holds a new body of `temperature` K together, its phase, and whether it is held in place.
void become(Body& body, const std::string& becoming, const Project& project, const PluginRegistry& plugins,
            double temperature);
/// Whether a body is already what a brush asks for, so that it takes more of it; one that asks for nothing takes any.
bool hasBecome(const Body& body, const std::string& becoming, const Project& project, const PluginRegistry& plugins,
               double temperature);

}  // namespace ps
