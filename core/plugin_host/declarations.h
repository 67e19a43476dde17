// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"

#include <phasesketch/constraint.h>
#include <phasesketch/material.h>
#include <phasesketch/parameter.h>

#include <string>
#include <string_view>
#include <vector>

// What a plugin declares is checked once, here, before anything else reads it: panels, JSON and the solver then take
// every declaration as sound. Each function returns "" or the first thing wrong, naming its place.
namespace ps {

/// Copies what a plugin declares, whatever headers it was built with.
std::string readParameters(api::ParameterList list, std::vector<api::ParameterDeclaration>& out);
std::string problemOfFields(api::List<api::FieldDeclaration> list);
std::string problemOfTraits(const api::StructuralPlugin& plugin);
std::string problemOfTraits(const api::GroupPlugin& plugin);
std::string problemOfTraits(const api::NeighbourPlugin& plugin);

/// Reads a plugin's properties into `material`, with sources and grades.
std::string readProperties(api::List<api::MaterialProperty> list, Material& material);
/// Keys known (the nearest is named otherwise), responses well formed and in range, relations between them sound.
std::string problemOfProperties(const Material& material);
/// "" or what is wrong with one property's value.
std::string problemOfProperty(const std::string& key, const Response& value);

}  // namespace ps
