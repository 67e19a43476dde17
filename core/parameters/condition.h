// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/parameters/parameterset.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

// What declarations say of other parameters: `enabledWhen` and `relations` of <phasesketch/parameter.h>, which holds
// the grammar. Keys are those of the same list, or addresses ("environment/radiation").
namespace ps {

enum class Comparison { Below, AtMost, Equal, AtLeast, Above, NotEqual };

/// "heat = fixed_temperature|convective", "solidus < liquidus", "wind_speed > 0".
struct Clause {
  std::string key;
  Comparison comparison = Comparison::Equal;
  std::variant<double, std::string, std::vector<std::string>> to;  ///< a number, another's key, names
};

/// All clauses hold; none: always.
struct Condition {
  std::vector<Clause> clauses;
};

struct Relation {
  bool must = true;  ///< else it should: what breaks it makes no sense, but does no harm
  Clause clause;     ///< of the declaration's own key
  std::string plus;  ///< key whose value is added to that one's; "" for none
  Condition when;
  std::optional<Condition> unless;
};

/// Values and declarations by key; nothing where there is none, as of a plugin that is not installed.
using ValueOfKey = std::function<std::optional<Value>(std::string_view key)>;
using DeclarationOfKey = std::function<const api::ParameterDeclaration*(std::string_view key)>;

/// Each throws InputError, which says what is wrong with the text; null is an empty one.
Condition parseCondition(const char* text);
std::vector<Relation> parseRelations(const api::ParameterDeclaration& declaration);
/// "" or what is wrong with `enabledWhen` and `relations`: their grammar, a key that `find` does not know, a comparison
/// that makes no sense for what is compared.
std::string problemOfRules(const api::ParameterDeclaration& declaration, const DeclarationOfKey& find);

/// Of unknown values: true.
bool holds(const Condition& condition, const ValueOfKey& values);
/// Of unknown values, and where the relation does not apply: true.
bool holds(const Relation& relation, const ValueOfKey& values);
/// Whether one of the clauses speaks of a key.
bool speaksOf(const Relation& relation, std::string_view key);

}  // namespace ps
