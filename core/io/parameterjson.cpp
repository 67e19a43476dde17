// SPDX-License-Identifier: Apache-2.0
#include "core/io/parameterjson.h"

#include "core/base/jsontext.h"

#include <algorithm>
#include <optional>

namespace ps {
namespace {

using nlohmann::json;

void merge(json& target, const json& unknown) {
  for (const auto& [key, value] : unknown.items()) {
    const auto found = target.find(key);
    if (found == target.end()) {
      target[key] = value;
    } else if (found->is_object() && value.is_object()) {
      merge(*found, value);
    }
  }
}

CurvePoint pointFromJson(const json& list) {
  CurvePoint point{list[0].get<double>(), list[1].get<double>()};
  if (list.size() < 3) return point;
  const auto slope = [&](const char* key) {
    const auto found = list[2].find(key);
    return found == list[2].end() ? std::nullopt : std::optional(found->get<double>());
  };
  const std::vector<std::string>& names = toNextNames();
  const auto way = std::find(names.begin(), names.end(), list[2].value("to_next", "smooth"));
  point.toNext = static_cast<ToNext>(way - names.begin());
  point.slopeBefore = slope("slope_before");
  point.slopeAfter = slope("slope_after");
  return point;
}

/// Two numbers, and how it goes on where that is not a monotone cubic.
json jsonFromPoint(const CurvePoint& point) {
  json list{jsonNumber(point.x), jsonNumber(point.y)}, way = json::object();
  if (point.toNext != ToNext::Smooth) way["to_next"] = toNextNames()[static_cast<size_t>(point.toNext)];
  if (point.slopeBefore) way["slope_before"] = jsonNumber(*point.slopeBefore);
  if (point.slopeAfter) way["slope_after"] = jsonNumber(*point.slopeAfter);
  if (!way.empty()) list.push_back(std::move(way));
  return list;
}

Response responseFromJson(json& value) {
  if (value.is_number()) return Response(value.get<double>());
  Response response;
  if (const auto curve = value.find("curve"); curve != value.end()) {
    response.kind = Response::Kind::Curve;
    for (const json& point : *curve) response.points.push_back(pointFromJson(point));
    value.erase(curve);
    return response;
  }
  response.kind = Response::Kind::Law;
  response.law = value.at("law").get<std::string>();
  response.coefficients = value.at("coefficients").get<std::vector<double>>();
  value.erase("law");
  value.erase("coefficients");
  return response;
}

json jsonFromResponse(const Response& response) {
  switch (response.kind) {
    case Response::Kind::Curve: {
      json points = json::array();
      for (const CurvePoint& p : response.points) points.push_back(jsonFromPoint(p));
      return {{"curve", points}};
    }
    case Response::Kind::Law: {
      json coefficients = json::array();
      for (const double c : response.coefficients) coefficients.push_back(jsonNumber(c));
      return {{"law", response.law}, {"coefficients", coefficients}};
    }
    default:
      return jsonNumber(response.constant);
  }
}

}  // namespace

void takeParameters(json& object, ParameterSet& set, api::ParameterList list) {
  for (size_t i = 0; i < list.count; ++i) {
    const api::ParameterDeclaration& declaration = list[i];
    const auto found = object.find(declaration.key);
    if (found == object.end()) continue;
    json value = std::move(*found);
    object.erase(found);
    set.values[declaration.key] = valueFromJson(value, declaration);
    if (value.is_object() && !value.empty()) object[declaration.key] = std::move(value);
  }
}

Value valueFromJson(json& value, const api::ParameterDeclaration& declaration) {
  switch (declaration.kind) {
    case api::ParameterKind::Toggle:
      return value.get<bool>();
    case api::ParameterKind::Choice:
      return value.get<std::string>();
    case api::ParameterKind::Response:
      return responseFromJson(value);
    default:
      return value.get<double>();
  }
}

json jsonFromValue(const Value& value) {
  if (const bool* toggle = std::get_if<bool>(&value)) return *toggle;
  if (const double* number = std::get_if<double>(&value)) return jsonNumber(*number);
  if (const std::string* name = std::get_if<std::string>(&value)) return *name;
  return jsonFromResponse(std::get<Response>(value));
}

json jsonFromVector(const Vector3& v) { return json::array({jsonNumber(v[0]), jsonNumber(v[1]), jsonNumber(v[2])}); }

Vector3 vectorFromJson(const json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

void putParameters(json& object, const ParameterSet& set) {
  for (const auto& [key, value] : set.values) object[key] = jsonFromValue(value);
}

void putUnknown(json& target, const Unknown& unknown) {
  if (unknown && unknown->is_object()) merge(target, *unknown);
}

}  // namespace ps
