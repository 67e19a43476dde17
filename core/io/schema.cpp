// SPDX-License-Identifier: Apache-2.0
#include "core/io/schema.h"

#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/io/fieldkinds.h"
#include "core/io/mixturefields.h"
#include "core/io/projectfields.h"
#include "core/parameters/wording.h"

namespace ps {
namespace {

using fields::numberSchema;
using nlohmann::json;

/// A name: letters and digits, and beyond the first of them what `more` says.
json nameSchema(const char* more, const char* help) {
  return {{"type", "string"},
          {"minLength", 1},
          {"maxLength", 100},
          {"pattern", std::string("^[A-Za-z0-9_][A-Za-z0-9_") + more + "]*$"},
          {"description", help}};
}

/// A value, a curve of points in temperature, or a named law.
json responseSchema(const api::ParameterDeclaration& d) {
  const json value = numberSchema(d.hardMinimum, d.hardMaximum, d.unit);
  const json slope = numberSchema(-1e300, 1e300, "");
  json toNext = fields::namesSchema(toNextNames());
  toNext["description"] = "what lies between it and the next point: its value, a straight line, or a cubic";
  const json way{{"type", "object"},
                 {"properties", {{"to_next", toNext}, {"slope_before", slope}, {"slope_after", slope}}},
                 {"description", "how the curve goes on; slopes, in units of the value per K, are of smooth pieces"}};
  const json point{{"type", "array"},
                   {"prefixItems", json::array({numberSchema(0, 1e5, "K"), value, way})},
                   {"minItems", 2},
                   {"maxItems", 3},
                   {"description", "temperature in K, value, and what differs from a monotone cubic"}};
  const json points{
      {"type", "array"},
      {"items", point},
      {"minItems", 1},
      {"maxItems", 1000},
      {"description", "points, ascending in temperature, joined by a monotone cubic where none says otherwise"}};
  json law = fields::namesSchema(lawNames());
  law["description"] = "a named law of temperature";
  const json coefficients{{"type", "array"},
                          {"items", numberSchema(-1e300, 1e300, "")},
                          {"maxItems", 16},
                          {"description", "in the order that the law takes"}};
  const auto object = [](const json& properties, const json& required, const char* help) {
    return json{{"type", "object"}, {"properties", properties}, {"required", required}, {"description", help}};
  };
  const json curve = object(json::object({{"curve", points}}), json::array({"curve"}), "a curve over temperature");
  const json named = object(json::object({{"law", law}, {"coefficients", coefficients}}),
                            json::array({"law", "coefficients"}), "a law over temperature");
  return {{"oneOf", json::array({value, curve, named})}};
}

json buildProjectSchema() {
  json schema = fields::projectFields().schema();
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = "PhaseSketch project";
  schema["$defs"] = {{"id", nameSchema(". -", "unique among its kind; others refer to it")},
                     {"plugin", nameSchema(".-", "id of a plugin")},
                     {"material", fields::materialFields().schema()},
                     {fields::kMixturePart, fields::mixturePartFields().schema()},
                     {"body", fields::bodyFields().schema()}};
  return schema;
}

}  // namespace

namespace fields {

json numberSchema(double minimum, double maximum, const char* unit) {
  json schema{{"type", "number"}, {"minimum", jsonNumber(minimum)}, {"maximum", jsonNumber(maximum)}};
  if (*unit) schema["x-unit"] = unit;
  return schema;
}

json namesSchema(const std::vector<std::string>& names) { return {{"type", "string"}, {"enum", names}}; }

json valueSchema() {
  api::ParameterDeclaration any;
  any.unit = "";
  any.hardMinimum = -1e300;
  any.hardMaximum = 1e300;
  json schema = responseSchema(any);
  for (const char* type : {"boolean", "string"}) schema["oneOf"].push_back({{"type", type}});
  return schema;
}

json definitionSchema(const char* name) { return {{"$ref", std::string("#/$defs/") + name}}; }

}  // namespace fields

json parameterSchema(const api::ParameterDeclaration& d, api::ParameterList list) {
  json schema;
  switch (d.kind) {
    case api::ParameterKind::Toggle:
      schema = {{"type", "boolean"}, {"default", d.defaultValue != 0}};
      break;
    case api::ParameterKind::Choice: {
      const std::vector<std::string> names = choicesOf(d);
      schema = {{"type", "string"}, {"enum", names}, {"default", names.at(static_cast<size_t>(d.defaultValue))}};
      break;
    }
    case api::ParameterKind::Response:
      schema = responseSchema(d);
      schema["default"] = jsonNumber(d.defaultValue);
      break;
    default:
      schema = numberSchema(d.hardMinimum, d.hardMaximum, d.unit);
      if (d.kind == api::ParameterKind::Integer) schema["type"] = "integer";
      schema["default"] = jsonNumber(d.defaultValue);
  }
  schema["title"] = d.label;
  const auto find = [&](std::string_view key) {
    return key.find('/') == std::string_view::npos ? findDeclaration(list, key) : sceneWideDeclaration(key);
  };
  std::string description = d.help;
  for (const std::string& rule : ruleTexts(d, find)) description += (description.empty() ? "" : " ") + rule;
  if (!description.empty()) schema["description"] = std::move(description);
  if (*d.example) schema["x-example"] = d.example;
  if (d.enabledWhen) schema["x-enabledWhen"] = d.enabledWhen;
  if (d.relations) schema["x-relations"] = d.relations;
  schema["x-actsAt"] = actsAtName(d.actsAt);
  return schema;
}

void addParameterSchemas(json& properties, api::ParameterList list) {
  for (size_t i = 0; i < list.count; ++i) {
    if (properties.contains(list[i].key)) throw Error(std::string(list[i].key) + ": is a key of its owner already");
    properties[list[i].key] = parameterSchema(list[i], list);
  }
}

json parameterListSchema(api::ParameterList list) {
  json properties = json::object();
  addParameterSchemas(properties, list);
  return {{"type", "object"}, {"properties", std::move(properties)}};
}

const json& projectSchema() {
  static const json schema = buildProjectSchema();
  return schema;
}

}  // namespace ps
