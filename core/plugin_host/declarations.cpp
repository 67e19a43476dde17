// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/declarations.h"

#include "core/base/nearest.h"
#include "core/parameters/condition.h"
#include "core/scene/project.h"

#include <QString>
#include <QUtf8StringView>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <set>
#include <vector>

namespace ps {
namespace {

constexpr size_t kMostDeclarations = 1000;

std::string place(const char* what, size_t index) { return std::string(what) + " " + std::to_string(index + 1) + ": "; }

std::string number(double value) {
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
  return error == std::errc() ? std::string(digits, end) : "?";
}

/// lower_snake_case
bool isKey(std::string_view key) {
  if (key.empty() || key.size() > 64 || key.front() < 'a' || key.front() > 'z') return false;
  return std::all_of(key.begin(), key.end(),
                     [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; });
}

/// Up to here every plugin knows a declaration; what comes behind has a default.
template <class T>
constexpr size_t kLeastSize = sizeof(T);
template <>
constexpr size_t kLeastSize<api::ParameterDeclaration> = offsetof(api::ParameterDeclaration, leastWord);

/// A list must have a place to read from, and elements at least as large as the first version's.
template <class T>
std::string problemOfList(const api::List<T>& list) {
  if (list.count > kMostDeclarations) return "declares more than " + std::to_string(kMostDeclarations) + " of them";
  if (list.count > 0 && !list.first) return "declares some, but gives a null pointer";
  if (list.count > 0 && (list.stride < kLeastSize<T> || list.stride % alignof(T) != 0))
    return "gives a stride of " + std::to_string(list.stride) +
           " bytes, which is not a declaration's size; use listOf()";
  return {};
}

size_t choiceCount(std::string_view choices) {
  return static_cast<size_t>(std::count(choices.begin(), choices.end(), '|')) + 1;
}

std::string problemOfChoices(std::string_view choices) {
  std::set<std::string_view> seen;
  for (size_t first = 0; first <= choices.size();) {
    const size_t last = std::min(choices.find('|', first), choices.size());
    const std::string_view name = choices.substr(first, last - first);
    if (name.empty()) return "has an empty choice; write them as \"first|second\"";
    if (!seen.insert(name).second) return "has the choice '" + std::string(name) + "' twice";
    first = last + 1;
  }
  return {};
}

std::string problemOfTexts(const api::ParameterDeclaration& p) {
  const std::pair<const char*, const char*> texts[] = {{"key", p.key},
                                                       {"label", p.label},
                                                       {"symbol", p.symbol},
                                                       {"unit", p.unit},
                                                       {"displayUnit", p.displayUnit},
                                                       {"choices", p.choices},
                                                       {"group", p.group},
                                                       {"help", p.help},
                                                       {"example", p.example},
                                                       {"source", p.source},
                                                       {"leastWord", p.leastWord ? p.leastWord : ""},
                                                       {"enabledWhen", p.enabledWhen ? p.enabledWhen : ""},
                                                       {"relations", p.relations ? p.relations : ""}};
  for (const auto& [name, text] : texts)
    if (const std::string problem = problemOfText(text); !problem.empty())
      return std::string("its ") + name + " " + problem;
  return {};
}

std::string problemOfNumbers(const api::ParameterDeclaration& p) {
  if (!std::isfinite(p.defaultValue)) return "its default is not a finite number";
  if (!std::isfinite(p.minimum) || !std::isfinite(p.maximum)) return "its range is not finite";
  if (std::isnan(p.hardMinimum) || std::isnan(p.hardMaximum)) return "its hard limits are not numbers";
  if (!(p.minimum <= p.maximum))
    return "its minimum " + number(p.minimum) + " is above its maximum " + number(p.maximum);
  if (!(p.hardMinimum <= p.minimum) || !(p.maximum <= p.hardMaximum))
    return "its range " + number(p.minimum) + " to " + number(p.maximum) + " leaves its hard limits " +
           number(p.hardMinimum) + " to " + number(p.hardMaximum);
  if (p.defaultValue < p.hardMinimum || p.defaultValue > p.hardMaximum)
    return "its default " + number(p.defaultValue) + " is outside its hard limits " + number(p.hardMinimum) + " to " +
           number(p.hardMaximum);
  if (!std::isfinite(p.displayScale) || p.displayScale == 0 || !std::isfinite(p.displayOffset))
    return "its display scale must be a number other than 0";
  if (p.scale != api::Scale::Linear && p.scale != api::Scale::Logarithmic) return "its scale is unknown";
  if (p.scale == api::Scale::Logarithmic && !(p.minimum > 0)) return "a logarithmic scale needs a minimum above 0";
  return {};
}

std::string problemOfKind(const api::ParameterDeclaration& p) {
  switch (p.kind) {
    case api::ParameterKind::Number:
    case api::ParameterKind::Response:
      return problemOfNumbers(p);
    case api::ParameterKind::Integer:
      return p.defaultValue == std::floor(p.defaultValue) ? problemOfNumbers(p) : "its default must be a whole number";
    case api::ParameterKind::Toggle:
      return p.defaultValue == 0 || p.defaultValue == 1 ? "" : "the default of a toggle must be 0 or 1";
    case api::ParameterKind::Choice: {
      if (std::string problem = problemOfChoices(p.choices); !problem.empty()) return problem;
      const bool index = p.defaultValue >= 0 && p.defaultValue == std::floor(p.defaultValue) &&
                         p.defaultValue < static_cast<double>(choiceCount(p.choices));
      return index ? "" : "its default must be the index of a choice";
    }
  }
  return "its kind is unknown to this program";
}

/// Of what it says of other parameters of the list, and of the scene's.
std::string ruleProblem(const api::ParameterDeclaration& p, const std::vector<api::ParameterDeclaration>& all) {
  if (p.actsAt != api::ActsAt::NextFrame && p.actsAt != api::ActsAt::NextReset)
    return "its actsAt must be NextFrame or NextReset";
  return problemOfRules(p, [&](std::string_view key) -> const api::ParameterDeclaration* {
    if (key.find('/') != std::string_view::npos) return sceneWideDeclaration(key);
    return findDeclaration(api::listOf(all.data(), all.size()), key);
  });
}

std::string suggestionFor(std::string_view key) {
  const api::ParameterList catalogue = propertyCatalogue();
  std::vector<std::string> keys;
  for (size_t i = 0; i < catalogue.count; ++i) keys.emplace_back(catalogue[i].key);
  return didYouMean(key, keys);
}

std::string problemOfRange(const api::ParameterDeclaration& p, double value) {
  if (value >= p.hardMinimum && value <= p.hardMaximum) return {};
  const std::string unit = *p.unit ? std::string(" ") + p.unit : std::string();
  return value < p.hardMinimum ? "must be at least " + number(p.hardMinimum) + unit + ", not " + number(value)
                               : "must be at most " + number(p.hardMaximum) + unit + ", not " + number(value);
}

}  // namespace

std::string problemOfText(const char* text) {
  constexpr size_t kLongest = 10'000;
  if (!text) return "is a null pointer; use \"\" for none";
  if (std::strlen(text) > kLongest) return "is longer than " + std::to_string(kLongest) + " bytes";
  return QUtf8StringView(text).isValidUtf8() ? "" : "is not UTF-8 text";
}

std::string readParameters(api::ParameterList list, std::vector<api::ParameterDeclaration>& out) {
  if (std::string problem = problemOfList(list); !problem.empty()) return "parameters: " + problem;
  std::set<std::string> keys;
  for (size_t i = 0; i < list.count; ++i) {
    const api::ParameterDeclaration p = out.emplace_back(list.at(i));
    if (const std::string problem = problemOfTexts(p); !problem.empty()) return place("parameter", i) + problem;
    const std::string where = "parameter '" + std::string(p.key) + "': ";
    if (!isKey(p.key)) return place("parameter", i) + "its key must be lower_snake_case, not '" + p.key + "'";
    if (!keys.insert(p.key).second) return where + "is declared twice";
    if (!*p.label) return where + "needs a label";
    if (const std::string problem = problemOfKind(p); !problem.empty()) return where + problem;
  }
  for (const api::ParameterDeclaration& p : out)
    if (const std::string problem = ruleProblem(p, out); !problem.empty())
      return "parameter '" + std::string(p.key) + "': " + problem;
  return {};
}

namespace {

/// Of what people see of a field.
std::string problemOfShown(const api::FieldDeclaration& f) {
  constexpr qsizetype kLongestLabel = 40;
  if (QString::fromUtf8(f.label).size() > kLongestLabel) return "its label is longer than 40 letters";
  if (!std::isfinite(f.minimum) || !std::isfinite(f.maximum) || f.minimum > f.maximum)
    return "its scale must go from a finite minimum up to a finite maximum";
  if (!*f.label) return {};
  if (f.type == api::FieldType::Float4) return "a Float4 is no number to be shown; leave out its label";
  const bool plain = std::all_of(f.name, f.name + std::strlen(f.name), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
  });
  return plain ? "" : "the name of one with a label has small letters, digits, '_', '-' and '.' alone";
}

}  // namespace

std::string readFields(api::List<api::FieldDeclaration> list, const FieldOwner& owner,
                       std::vector<api::FieldDeclaration>& out) {
  if (std::string problem = problemOfList(list); !problem.empty()) return "fields: " + problem;
  std::set<std::string> names;
  for (size_t i = 0; i < list.count; ++i) {
    const api::FieldDeclaration f = out.emplace_back(list.at(i));
    if (!f.name || !*f.name) return place("field", i) + "needs a name";
    for (const char* text : {f.name, f.unit, f.help, f.label})
      if (const std::string problem = problemOfText(text); !problem.empty())
        return place("field", i) + "a text of it " + problem;
    if (!names.insert(f.name).second) return "field '" + std::string(f.name) + "': is declared twice";
    if (!owner.named(f.name))
      return "field '" + std::string(f.name) + "': its name must begin with the plugin's id and a dot, \"" + owner.id +
             "." + f.name + "\"";
    if (f.type > api::FieldType::Float4)
      return "field '" + std::string(f.name) + "': its type is unknown to this program";
    if (const std::string problem = problemOfShown(f); !problem.empty())
      return "field '" + std::string(f.name) + "': " + problem;
  }
  return {};
}

namespace {

std::string problemOfValues(api::List<api::FieldDeclaration> values, const std::string& whose) {
  constexpr size_t kMost = 16;
  std::vector<api::FieldDeclaration> all;
  if (std::string problem = readFields(values, {}, all); !problem.empty()) return whose + " " + problem;
  if (values.count > kMost) return "it declares more than 16 " + whose + " values";
  for (const api::FieldDeclaration& value : all) {
    if (value.type != api::FieldType::Float32)
      return "the " + whose + " value '" + std::string(value.name) + "' must be a Float32";
  }
  return {};
}

constexpr const char* kNoTraits = "its traits() says nothing: return fill(out, {...})";

}  // namespace

std::string readTraits(const api::StructuralPlugin& plugin, const FieldOwner& owner,
                       std::vector<api::FieldDeclaration>& out) {
  api::StructuralTraits traits;
  if (!plugin.traits(&traits)) return kNoTraits;
  if (traits.arity < 2 || traits.arity > 4)
    return "a structural constraint joins 2 to 4 particles, not " + std::to_string(traits.arity);
  if (std::string problem = problemOfValues(traits.values, "per-constraint"); !problem.empty()) return problem;
  return readFields(traits.fields, owner, out);
}

std::string readTraits(const api::GroupPlugin& plugin, const FieldOwner& owner,
                       std::vector<api::FieldDeclaration>& out) {
  api::GroupTraits traits;
  if (!plugin.traits(&traits)) return kNoTraits;
  if (std::string problem = problemOfValues(traits.values, "per-group"); !problem.empty()) return problem;
  if (std::string problem = problemOfValues(traits.memberValues, "per-member"); !problem.empty()) return problem;
  return readFields(traits.fields, owner, out);
}

std::string readTraits(const api::NeighbourPlugin& plugin, const FieldOwner& owner,
                       std::vector<api::FieldDeclaration>& out) {
  api::NeighbourTraits traits;
  return plugin.traits(&traits) ? readFields(traits.fields, owner, out) : kNoTraits;
}

std::string readProperties(api::List<api::MaterialProperty> list, Material& material) {
  if (std::string problem = problemOfList(list); !problem.empty()) return "properties: " + problem;
  for (size_t i = 0; i < list.count; ++i) {
    const api::MaterialProperty property = list.at(i);
    if (!property.key || !*property.key) return place("property", i) + "its key is a null pointer or empty";
    const std::string where = "property '" + std::string(property.key) + "': ";
    if (const std::string problem = problemOfText(property.source); !problem.empty())
      return where + "its source " + problem;
    if (property.grade < 'A' || property.grade > 'C') return where + "its grade must be 'A', 'B' or 'C'";
    const bool hasPoints = property.value.points.data || property.value.points.size == 0;
    const bool hasCoefficients = property.value.coefficients.data || property.value.coefficients.size == 0;
    if (!hasPoints || !hasCoefficients) return where + "its points or coefficients are a null pointer";
    if (!material.properties.emplace(property.key, Response(property.value)).second) return where + "is given twice";
    material.provenance[property.key] = {property.source, property.grade};
  }
  return {};
}

std::string problemOfProperty(const std::string& key, const Response& value) {
  const int index = propertyIndex(key);
  if (index < 0) return "is not a property that PhaseSketch knows" + suggestionFor(key);
  const api::ParameterDeclaration& declaration = propertyCatalogue()[static_cast<size_t>(index)];
  if (value.kind != Response::Kind::Constant && declaration.kind != api::ParameterKind::Response)
    return "must be a single number: it does not depend on temperature here";
  if (std::string problem = value.problem(); !problem.empty()) return problem;
  if (value.kind == Response::Kind::Constant) return problemOfRange(declaration, value.constant);
  for (const CurvePoint& point : value.points) {
    if (!(point.x > 0)) return "a point lies at " + number(point.x) + " K; temperatures are in kelvin, above 0";
    if (std::string problem = problemOfRange(declaration, point.y); !problem.empty())
      return "at " + number(point.x) + " K " + problem;
  }
  for (const CurvePoint& turn : value.turns()) {
    if (std::string problem = problemOfRange(declaration, turn.y); !problem.empty())
      return "at " + number(turn.x) + " K, where the slopes of its points lead, " + problem;
  }
  return {};
}

std::string problemOfProperties(const Material& material) {
  for (const auto& [key, value] : material.properties)
    if (const std::string problem = problemOfProperty(key, value); !problem.empty())
      return "property '" + key + "': " + problem;
  const std::string problem = problemOf(material);
  return problem.empty() ? problem : "property " + problem;
}

}  // namespace ps
