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

/// A text must be there, of bounded length, and UTF-8: it is written into JSON and onto the screen.
std::string problemOfText(const char* text);
/// Copies what a plugin declares, whatever headers it was built with.
std::string readParameters(api::ParameterList list, std::vector<api::ParameterDeclaration>& out);
/// Whose per-particle fields they are. Names begin with the plugin's id, so that none takes another's away; the
/// program's own plugins share some.
struct FieldOwner {
  std::string id;  ///< "": names are not seen by anybody else
  bool own = false;
  bool named(std::string_view field) const {
    return id.empty() || own || (field.starts_with(id) && field.size() > id.size() + 1 && field[id.size()] == '.');
  }
};
/// Copies the fields that a plugin declares.
std::string readFields(api::List<api::FieldDeclaration> list, const FieldOwner& owner,
                       std::vector<api::FieldDeclaration>& out);
/// Checks what a constraint says of itself, and copies its fields.
std::string readTraits(const api::StructuralPlugin& plugin, const FieldOwner& owner,
                       std::vector<api::FieldDeclaration>& out);
std::string readTraits(const api::GroupPlugin& plugin, const FieldOwner& owner,
                       std::vector<api::FieldDeclaration>& out);
std::string readTraits(const api::NeighbourPlugin& plugin, const FieldOwner& owner,
                       std::vector<api::FieldDeclaration>& out);

/// Reads a plugin's properties into `material`, with sources and grades.
std::string readProperties(api::List<api::MaterialProperty> list, Material& material);
/// Keys known (the nearest is named otherwise), responses well formed and in range, relations between them sound.
std::string problemOfProperties(const Material& material);
/// "" or what is wrong with one property's value.
std::string problemOfProperty(const std::string& key, const Response& value);

}  // namespace ps
