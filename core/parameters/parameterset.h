// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/parameter.h>

#include "core/math/response.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ps {

/// A parameter's value: Toggle, Number or Integer, Choice, Response.
using Value = std::variant<bool, double, std::string, Response>;

/// Values set explicitly, by key; whatever is absent has the declaration's default.
class ParameterSet {
 public:
  std::map<std::string, Value> values;
  bool operator==(const ParameterSet&) const = default;
};

/// The declaration of `key`, or nullptr.
const api::ParameterDeclaration* findDeclaration(api::ParameterList list, std::string_view key);
/// Explicit value or default.
Value valueOf(const ParameterSet& set, const api::ParameterDeclaration& declaration);
double numberOf(const ParameterSet& set, api::ParameterList list, std::string_view key);
std::string choiceOf(const ParameterSet& set, api::ParameterList list, std::string_view key);
bool toggleOf(const ParameterSet& set, api::ParameterList list, std::string_view key);
/// All values as numbers in the order of the list (Choice: index, Toggle: 0 or 1, Response: constant), as plugins get
/// them.
std::vector<double> numbersOf(const ParameterSet& set, api::ParameterList list);
/// A value as a response: a number or a toggle (0 or 1) is a constant one.
Response responseOf(const Value& value);
/// Names of a Choice, in order.
std::vector<std::string> choicesOf(const api::ParameterDeclaration& declaration);
/// A value that stands for none, and the word for it.
struct NoValue {
  double stored;
  const char* word;
};
std::optional<NoValue> noValueOf(const api::ParameterDeclaration& declaration);
/// "" or "must be at least 1 kg/m³, not −5" for a number outside [minimum, maximum].
std::string rangeProblem(double value, double minimum, double maximum, std::string_view unit);
/// Shortest text that reads back as the same number, with a real minus sign: "−0.0375".
std::string numberText(double value);
/// "" or what is wrong with a value: "must be a number", "must be at least 1 kg/m³, not −5".
std::string problemOf(const Value& value, const api::ParameterDeclaration& declaration);

}  // namespace ps
