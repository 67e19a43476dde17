// SPDX-License-Identifier: Apache-2.0
#include "core/io/schema.h"

#include "core/base/jsontext.h"
#include "core/matter/material.h"
#include "core/scene/project.h"

namespace ps {
namespace {

using nlohmann::json;

constexpr double kFarthest = 1e4;  // m, m/s, m/s2: beyond it float32 positions lose the particle

json text(const char* description) { return {{"type", "string"}, {"description", description}}; }

json number(double minimum, double maximum, const char* unit, const char* description) {
  json schema{{"type", "number"}, {"minimum", jsonNumber(minimum)}, {"maximum", jsonNumber(maximum)}};
  if (*unit) schema["x-unit"] = unit;
  if (*description) schema["description"] = description;
  return schema;
}

json integer(int64_t minimum, int64_t maximum, const char* description) {
  return {{"type", "integer"}, {"minimum", minimum}, {"maximum", maximum}, {"description", description}};
}

json toggle(const char* description) { return {{"type", "boolean"}, {"description", description}}; }

/// A name that belongs to the format though nothing reads it yet; its value may be anything.
json reserved(const char* description) { return {{"description", description}}; }

json ref(const char* definition) { return {{"$ref", std::string("#/$defs/") + definition}}; }

json listOf(const json& items, const char* description) {
  return {{"type", "array"}, {"items", items}, {"description", description}};
}

json oneOfNames(const std::vector<std::string>& names, const char* description) {
  return {{"type", "string"}, {"enum", names}, {"description", description}};
}

json object(json properties, const std::vector<std::string>& required, const char* description) {
  json schema{{"type", "object"}, {"properties", std::move(properties)}, {"description", description}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

json freeParameters(const char* description) { return {{"type", "object"}, {"description", description}}; }

json vector3(const char* unit, const char* description) {
  return {{"type", "array"},
          {"items", number(-kFarthest, kFarthest, unit, "")},
          {"minItems", 3},
          {"maxItems", 3},
          {"description", description}};
}

json tuple(std::vector<json> items, const char* description) {
  const size_t count = items.size();
  return {{"type", "array"},
          {"prefixItems", std::move(items)},
          {"minItems", count},
          {"maxItems", count},
          {"description", description}};
}

/// Adds declared parameters as keys of their owner.
json withParameters(json properties, api::ParameterList list) {
  for (size_t i = 0; i < list.count; ++i) properties[list[i].key] = parameterSchema(list[i]);
  return properties;
}

json responseSchema(const api::ParameterDeclaration& d) {
  const json value = number(d.hardMinimum, d.hardMaximum, d.unit, "");
  const json point = tuple({number(0, 1e5, "K", ""), value}, "temperature in K, value");
  json points = listOf(point, "points, ascending in temperature, joined by a monotone cubic");
  points["minItems"] = 1;
  points["maxItems"] = 1000;
  json coefficients = listOf(number(-1e300, 1e300, "", ""), "in the order that the law takes");
  coefficients["maxItems"] = 16;
  return {{"oneOf",
           {value, object({{"curve", points}}, {"curve"}, "a curve over temperature"),
            object({{"law", oneOfNames(lawNames(), "a named law of temperature")}, {"coefficients", coefficients}},
                   {"law", "coefficients"}, "a law over temperature")}}};
}

json materialSchema() {
  return object({{"id", ref("id")},
                 {"label", text("name shown to people")},
                 {"base", ref("plugin")},
                 {"properties", parameterListSchema(propertyCatalogue())},
                 {"parameters", freeParameters("the material plugin's own parameters")},
                 {"adheres_to", listOf(text("id of a material, installed or of the scene"),
                                       "materials that it holds on to when one of the two freezes, in place of those "
                                       "that the installed one names")}},
                {"id", "base"}, "an installed material with changed properties");
}

json boxSchema() {
  return object({{"center", vector3("m", "centre")},
                 {"size",
                  {{"type", "array"},
                   {"items", number(1e-6, kFarthest, "m", "")},
                   {"minItems", 3},
                   {"maxItems", 3},
                   {"description", "edge lengths"}}}},
                {"center", "size"}, "a block of particles on a cubic lattice");
}

json voxelSchema() {
  const json coordinate = integer(-1'000'000, 1'000'000, "");
  const json paint = object({{"material", ref("id")}, {"temperature", number(1, 10000, "K", "")}},
                            {"material", "temperature"}, "what cells are made of");
  const json stroke = object(
      {{"brush", ref("plugin")},
       {"erase", toggle("takes matter away")},
       {"radius", number(1e-6, kFarthest, "m", "size of the brush")},
       {"palette", integer(0, 65535, "index into the palette")},
       {"parameters", freeParameters("the brush's own parameters")},
       {"samples", listOf(tuple({number(-kFarthest, kFarthest, "m", ""), number(-kFarthest, kFarthest, "m", ""),
                                 number(-kFarthest, kFarthest, "m", ""), number(0, 1, "", ""), number(0, 1e9, "s", "")},
                                "x, y, z, pressure, time"),
                          "where the hand went")}},
      {"brush", "radius", "palette", "samples"}, "how cells were drawn");
  return object(
      {{"origin", vector3("m", "centre of cell (0, 0, 0)")},
       {"spacing", number(0.0005, 10, "m", "edge of a cell; the scene's particle spacing where it is left out")},
       {"palette", listOf(paint, "materials of the cells")},
       {"runs", listOf(tuple({coordinate, coordinate, coordinate, integer(1, 1'000'000, "cells along x"),
                              integer(0, 65535, "index into the palette")},
                             "x, y, z, length, palette"),
                       "filled cells as runs along x")},
       {"strokes", listOf(stroke, "how it was drawn, so that it stays editable")}},
      {"origin", "palette", "runs"}, "sketched cells");
}

json regionSchema(const char* description) {
  return object({{"minimum", vector3("m", "")}, {"maximum", vector3("m", "")}}, {"minimum", "maximum"}, description);
}

json waveSchema(const json& more, const std::vector<std::string>& required, const char* description) {
  json properties{{"axis", oneOfNames({"x", "y", "z"}, "along which it changes")},
                  {"wavelength", number(1e-6, kFarthest, "m", "")},
                  {"phase", number(-kFarthest, kFarthest, "rad", "at the origin of the scene")}};
  properties.update(more);
  return object(std::move(properties), required, description);
}

json bodySchema() {
  const json constraint =
      object({{"plugin", ref("plugin")}, {"parameters", freeParameters("the constraint's own parameters")}}, {"plugin"},
             "a constraint plugin that holds the body together");
  const json shape{{"oneOf",
                    {object({{"box", boxSchema()}}, {"box"}, "a block"),
                     object({{"voxels", voxelSchema()}}, {"voxels"}, "a sketch")}}};
  return object(
      withParameters({{"id", ref("id")},
                      {"name", text("name shown to people")},
                      {"material", ref("id")},
                      {"shape", shape},
                      {"velocity", vector3("m/s", "velocity at the start; of a fixed body as long as it moves")},
                      {"spin", vector3("rad/s", "turns about its centre, likewise")},
                      {"velocity_wave", waveSchema({{"velocity", vector3("m/s", "amplitude")}},
                                                   {"axis", "wavelength", "velocity"}, "a sine added to the velocity")},
                      {"temperature_gradient", vector3("K/m", "about the body's centre, where its temperature holds")},
                      {"pins", listOf(regionSchema("a box; its faces belong to it"),
                                      "particles that stand in one of these at the start are held in place")},
                      {"constraints", listOf(constraint, "what holds it together")},
                      {"visible", toggle("drawn")},
                      {"locked", toggle("protected from edits")}},
                     bodyParameters()),
      {"id", "material", "shape"}, "matter at the start");
}

json environmentSchema() {
  const json wall = object(withParameters({{"id", ref("id")},
                                           {"name", text("name shown to people")},
                                           {"point", vector3("m", "a point on the wall")},
                                           {"normal", vector3("", "direction into the scene, any length but zero")}},
                                          wallParameters()),
                           {"id", "point", "normal"}, "a half-space that particles cannot enter");
  const json bounds = object({{"minimum", vector3("m", "")}, {"maximum", vector3("m", "")}}, {"minimum", "maximum"},
                             "particles that leave this box are lost");
  const json periodic{
      {"type", "array"},
      {"items", toggle("")},
      {"minItems", 3},
      {"maxItems", 3},
      {"description",
       "whether the bounds repeat along x, y and z: what leaves by one face comes in by the other; such "
       "an edge is at least three times as long as particles reach, and no wall leans along it"}};
  return object(withParameters({{"gravity", vector3("m/s²", "gravity")},
                                {"bounds", bounds},
                                {"periodic", periodic},
                                {"walls", listOf(wall, "floor, lid, sides of a tray")}},
                               environmentParameters()),
                {}, "what surrounds the matter");
}

json emitterSchema() {
  return object(withParameters({{"id", ref("id")},
                                {"name", text("name shown to people")},
                                {"material", ref("id")},
                                {"point", vector3("m", "centre of the mouth")},
                                {"direction", vector3("", "of the jet, any length but zero")}},
                               emitterParameters()),
                {"id", "material", "point", "direction"}, "a nozzle that adds matter while the scene runs");
}

json sinkSchema() {
  return object(withParameters({{"id", ref("id")},
                                {"name", text("name shown to people")},
                                {"minimum", vector3("m", "corner of the box")},
                                {"maximum", vector3("m", "the corner opposite")}},
                               sinkParameters()),
                {"id", "minimum", "maximum"}, "a box that takes away what enters it");
}

json solverSchema() {
  const json thermal =
      object({{"model",
               {{"type", "string"}, {"maxLength", 100}, {"description", "id of a thermal plugin; empty for no heat"}}},
              {"parameters", freeParameters("the thermal model's own parameters")}},
             {"model"}, "how heat is kept");
  return object(withParameters({{"thermal", thermal}}, solverParameters()), {}, "how it is computed");
}

json probeSchema() {
  return object({{"id", ref("id")},
                 {"name", {{"type", "string"}, {"maxLength", 200}, {"description", "name in graphs and tables"}}},
                 {"quantity", oneOfNames(probeQuantities(), "what is measured")},
                 {"body", {{"type", "string"}, {"description", "id of a body; empty for all particles"}}},
                 {"phase", oneOfNames({"", "solid", "melting", "liquid", "boiling", "gas"}, "empty for all")},
                 {"fixed",
                  {{"type", "boolean"},
                   {"description", "sees what is held in place as well, as one of a fixed body always does"}}},
                 {"region", regionSchema("only particles that stood in it at the start; its faces belong to it")},
                 {"wave", waveSchema(json::object(), {"axis", "wavelength"},
                                     "measures the amplitude of this sine in the quantity, not the quantity")}},
                {"id", "quantity"}, "something measured each frame");
}

json viewSchema() {
  return object(
      {{"target", vector3("m", "what the camera looks at")},
       {"distance", number(1e-4, 1e5, "m", "of the camera from its target")},
       {"azimuth", number(-36000, 36000, "°", "")},
       {"elevation", number(-90, 90, "°", "")},
       {"colour", oneOfNames({"material", "temperature", "phase", "speed", "density_error"}, "what colours mean")},
       {"pinned", listOf(text("address of a parameter: wall/floor/temperature"), "rows under Try these")}},
      {}, "how it is looked at; without target, distance and angles the whole scene is shown");
}

json buildProjectSchema() {
  json schema =
      object({{"format", {{"const", "phasesketch"}}},
              {"version", integer(1, 1'000'000, "format of this file; a newer one is read when minVersion allows it")},
              {"minVersion", integer(1, kProjectVersion, "oldest format that a reader must know; absent: version")},
              {"generator", text("program that wrote the file")},
              {"title", text("shown to people")},
              {"description", text("shown to people")},
              {"pluginsUsed", listOf(ref("plugin"), "missing ones are a warning")},
              {"pluginsRequired", listOf(ref("plugin"), "missing ones are an error")},
              {"materials", listOf(ref("material"), "materials of the scene")},
              {"bodies", listOf(ref("body"), "matter at the start")},
              {"emitters", listOf(emitterSchema(), "matter that comes while the scene runs")},
              {"sinks", listOf(sinkSchema(), "where matter goes")},
              {"environment", environmentSchema()},
              {"solver", solverSchema()},
              {"probes", listOf(probeSchema(), "what is measured")},
              {"tracks", reserved("parameters over time; kept, not used by this version")},
              {"state", reserved("matter as it stands at some later time; kept, not used by this version")},
              {"duration", number(0, 1e9, "s", "length of the scene")},
              {"view", viewSchema()}},
             {"format", "version", "materials", "bodies"},
             "Keys that a reader does not know are kept when the project is saved again.");
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = "PhaseSketch project";
  schema["$defs"] = {{"id",
                      {{"type", "string"},
                       {"minLength", 1},
                       {"maxLength", 100},
                       {"pattern", "^[A-Za-z0-9_][A-Za-z0-9_. -]*$"},
                       {"description", "unique among its kind; others refer to it"}}},
                     {"plugin",
                      {{"type", "string"},
                       {"minLength", 1},
                       {"maxLength", 100},
                       {"pattern", "^[A-Za-z0-9_][A-Za-z0-9_.-]*$"},
                       {"description", "id of a plugin"}}},
                     {"material", materialSchema()},
                     {"body", bodySchema()}};
  return schema;
}

}  // namespace

json parameterSchema(const api::ParameterDeclaration& d) {
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
      schema = number(d.hardMinimum, d.hardMaximum, d.unit, "");
      if (d.kind == api::ParameterKind::Integer) schema["type"] = "integer";
      schema["default"] = jsonNumber(d.defaultValue);
  }
  schema["title"] = d.label;
  if (*d.help) schema["description"] = d.help;
  if (*d.example) schema["x-example"] = d.example;
  return schema;
}

json parameterListSchema(api::ParameterList list) {
  return {{"type", "object"}, {"properties", withParameters(json::object(), list)}};
}

const json& projectSchema() {
  static const json schema = buildProjectSchema();
  return schema;
}

}  // namespace ps
