// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/simulation/particlefield.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

// A probe as rows show it: what it measures, of which matter, where. Pure functions.
namespace ps {

/// Stands for all bodies, materials, phases, or for no wall, among the choices of a probe.
inline constexpr const char* kProbeAll = "*";

/// Declarations of probes of a project: quantity, body, wall, material, phase, fixed, in_box, box_when, box_min_x ...
/// box_max_z.
std::vector<api::ParameterDeclaration> probeParameters(const Project& project, const ParticleFields& fields);
/// What a probe has of these; of a box that it does not have, the scene's bounds. Nothing for other keys.
std::optional<Value> probeValue(const Probe& probe, const std::string& key, const Environment& environment);
/// Sets it, whether or not the others go with it. False, and nothing happens, for other keys and types.
bool setProbeValue(Probe& probe, const std::string& key, const Value& value, const Environment& environment);
/// Makes the others go with the key that somebody has just set: a wall takes a force in place of what is of matter, a
/// force the first wall or body where there is none, and another quantity no wall.
void followChoice(Probe& probe, const std::string& key, const Project& project);
/// Keys of a probe that cannot stand together, as files name them, each with what is wrong: {"wall", "is for force
/// ..."}.
std::vector<std::pair<std::string, std::string>> probeProblems(const Probe& probe, const ParticleFields& fields);

}  // namespace ps
