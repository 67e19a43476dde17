// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <nlohmann/json.hpp>

namespace ps {

/// Moves the declared parameters that stand directly in `object` into `set`; others stay, and of a curve or a law what
/// is not known. Values must have been checked.
void takeParameters(nlohmann::json& object, ParameterSet& set, api::ParameterList list);
/// A checked JSON value as the declaration's kind of value; unknown members of a curve or law stay in `value`.
Value valueFromJson(nlohmann::json& value, const api::ParameterDeclaration& declaration);
nlohmann::json jsonFromValue(const Value& value);
nlohmann::json jsonFromVector(const Vector3& vector);
/// A list of three numbers.
Vector3 vectorFromJson(const nlohmann::json& list);
/// Writes all values of a set as members of an object.
void putParameters(nlohmann::json& object, const ParameterSet& set);
/// Adds what a reader did not know, at every level; known members win.
void putUnknown(nlohmann::json& target, const Unknown& unknown);

}  // namespace ps
