// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <nlohmann/json.hpp>

namespace ps {

/// Takes members out of an object; what is left over at the end is what this version does not know.
class JsonTaker {
 public:
  /// `object` must be an object; it shrinks as members are taken.
  explicit JsonTaker(nlohmann::json& object) : m_object(object) {}
  bool has(const char* key) const { return m_object.contains(key); }
  /// Moves a member out; null when there is none.
  nlohmann::json take(const std::string& key);
  std::string text(const char* key, const std::string& fallback = "");
  double number(const char* key, double fallback);
  bool toggle(const char* key, bool fallback);
  Vector3 vector(const char* key, const Vector3& fallback);
  std::vector<std::string> names(const char* key);
  /// Puts a member back: the part of it that is not known.
  void keep(const std::string& key, nlohmann::json&& rest);
  /// The declared parameters that stand directly in the object. Values must have been checked.
  void parameters(ParameterSet& set, api::ParameterList list);
  /// The declared parameters inside the member `key`; others stay in it.
  void parameters(const char* key, ParameterSet& set, api::ParameterList list);
  /// What is left, or nullptr.
  Unknown rest();

 private:
  nlohmann::json& m_object;
};

/// A checked JSON value as the declaration's kind of value; unknown members of a curve or law stay in `value`.
Value valueFromJson(nlohmann::json& value, const api::ParameterDeclaration& declaration);
nlohmann::json jsonFromValue(const Value& value);
nlohmann::json jsonFromVector(const Vector3& vector);
/// Writes all values of a set as members of an object.
void putParameters(nlohmann::json& object, const ParameterSet& set);
/// Adds what a reader did not know, at every level; known members win.
void putUnknown(nlohmann::json& target, const Unknown& unknown);

}  // namespace ps
