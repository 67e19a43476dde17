// SPDX-License-Identifier: Apache-2.0
#include "core/parameters/parameterset.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ps {
namespace {

using api::ParameterKind;

std::string withUnit(double value, std::string_view unit) {
  return unit.empty() ? numberText(value) : numberText(value) + " " + std::string(unit);
}

std::string problemOfNumber(const Value& value, const api::ParameterDeclaration& d) {
  const double* number = std::get_if<double>(&value);
  if (!number) return "must be a number";
  if (d.kind == ParameterKind::Integer && std::isfinite(*number) && *number != std::floor(*number)) {
    return "must be a whole number, not " + numberText(*number);
  }
  return rangeProblem(*number, d.hardMinimum, d.hardMaximum, d.unit);
}

std::string problemOfChoice(const Value& value, const api::ParameterDeclaration& d) {
  const std::string* name = std::get_if<std::string>(&value);
  std::string choices;
  for (const std::string& choice : choicesOf(d)) {
    if (name && choice == *name) return "";
    choices += (choices.empty() ? "" : ", ") + choice;
  }
  return "must be one of " + choices + (name ? ", not '" + *name + "'" : "");
}

std::string problemOfResponse(const Value& value, const api::ParameterDeclaration& d) {
  if (const double* number = std::get_if<double>(&value)) {
    return rangeProblem(*number, d.hardMinimum, d.hardMaximum, d.unit);
  }
  const Response* response = std::get_if<Response>(&value);
  if (!response) return "must be a number, a curve or a law";
  if (std::string problem = response->problem(); !problem.empty()) return problem;
  if (response->kind == Response::Kind::Constant) {
    return rangeProblem(response->constant, d.hardMinimum, d.hardMaximum, d.unit);
  }
  for (const CurvePoint& point : response->points) {
    const std::string problem = rangeProblem(point.y, d.hardMinimum, d.hardMaximum, d.unit);
    if (!problem.empty()) return "at " + withUnit(point.x, "K") + ": " + problem;
  }
  for (const CurvePoint& turn : response->turns()) {
    const std::string problem = rangeProblem(turn.y, d.hardMinimum, d.hardMaximum, d.unit);
    if (!problem.empty()) return "at " + withUnit(turn.x, "K") + ", where the slopes of its points lead: " + problem;
  }
  return "";
}

}  // namespace

const api::ParameterDeclaration* findDeclaration(api::ParameterList list, std::string_view key) {
  for (size_t i = 0; i < list.count; ++i) {
    if (key == list[i].key) return &list[i];
  }
  return nullptr;
}

std::vector<std::string> choicesOf(const api::ParameterDeclaration& declaration) {
  std::vector<std::string> names;
  const std::string_view all = declaration.choices ? declaration.choices : "";
  for (size_t first = 0; first < all.size();) {
    const size_t last = std::min(all.find('|', first), all.size());
    names.emplace_back(all.substr(first, last - first));
    first = last + 1;
  }
  return names;
}

Value valueOf(const ParameterSet& set, const api::ParameterDeclaration& declaration) {
  if (const auto found = set.values.find(declaration.key); found != set.values.end()) return found->second;
  switch (declaration.kind) {
    case ParameterKind::Toggle:
      return declaration.defaultValue != 0;
    case ParameterKind::Choice: {
      const std::vector<std::string> choices = choicesOf(declaration);
      const auto index = static_cast<size_t>(declaration.defaultValue);
      return index < choices.size() ? choices[index] : std::string();
    }
    case ParameterKind::Response:
      return Response(declaration.defaultValue);
    default:
      return declaration.defaultValue;
  }
}

double numberOf(const ParameterSet& set, api::ParameterList list, std::string_view key) {
  const api::ParameterDeclaration* declaration = findDeclaration(list, key);
  if (!declaration) return 0;
  const Value value = valueOf(set, *declaration);
  if (const double* number = std::get_if<double>(&value)) return *number;
  if (const bool* toggle = std::get_if<bool>(&value)) return *toggle ? 1 : 0;
  if (const Response* response = std::get_if<Response>(&value)) return response->constant;
  const std::vector<std::string> choices = choicesOf(*declaration);
  for (size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == std::get<std::string>(value)) return static_cast<double>(i);
  }
  return declaration->defaultValue;
}

std::string choiceOf(const ParameterSet& set, api::ParameterList list, std::string_view key) {
  const api::ParameterDeclaration* declaration = findDeclaration(list, key);
  if (!declaration) return "";
  const Value value = valueOf(set, *declaration);
  const std::string* name = std::get_if<std::string>(&value);
  return name ? *name : "";
}

bool toggleOf(const ParameterSet& set, api::ParameterList list, std::string_view key) {
  return numberOf(set, list, key) != 0;
}

std::vector<double> numbersOf(const ParameterSet& set, api::ParameterList list) {
  std::vector<double> numbers(list.count);
  for (size_t i = 0; i < list.count; ++i) numbers[i] = numberOf(set, list, list[i].key);
  return numbers;
}

Response responseOf(const Value& value) {
  if (const auto* response = std::get_if<Response>(&value)) return *response;
  if (const auto* number = std::get_if<double>(&value)) return *number;
  const auto* toggle = std::get_if<bool>(&value);
  return toggle && *toggle ? 1.0 : 0.0;
}

std::optional<NoValue> noValueOf(const api::ParameterDeclaration& d) {
  if (d.leastWord) return NoValue{d.hardMinimum, d.leastWord};
  const std::string_view unit = d.unit ? d.unit : "";
  if (unit == "K" && d.displayOffset != 0 && d.hardMinimum <= 0) return NoValue{0, "none"};
  if (unit == "s" && d.hardMaximum >= 1e9) return NoValue{d.hardMaximum, "never"};
  return std::nullopt;
}

std::string numberText(double value) {
  if (std::isnan(value)) return "NaN";
  char buffer[40];
  const double size = std::fabs(value);
  const bool plain = size >= 1e-4 && size < 1e15;
  const auto end = (plain ? std::to_chars(buffer, buffer + sizeof buffer, size, std::chars_format::fixed)
                          : std::to_chars(buffer, buffer + sizeof buffer, size))
                       .ptr;
  return (value < 0 ? "\u2212" : "") + std::string(buffer, end);
}

std::string rangeProblem(double value, double minimum, double maximum, std::string_view unit) {
  if (!std::isfinite(value)) return "must be a finite number, not " + numberText(value);
  if (value < minimum) return "must be at least " + withUnit(minimum, unit) + ", not " + numberText(value);
  if (value > maximum) return "must be at most " + withUnit(maximum, unit) + ", not " + numberText(value);
  return "";
}

std::string problemOf(const Value& value, const api::ParameterDeclaration& declaration) {
  switch (declaration.kind) {
    case ParameterKind::Toggle:
      return std::holds_alternative<bool>(value) ? "" : "must be true or false";
    case ParameterKind::Choice:
      return problemOfChoice(value, declaration);
    case ParameterKind::Response:
      return problemOfResponse(value, declaration);
    default:
      return problemOfNumber(value, declaration);
  }
}

}  // namespace ps
