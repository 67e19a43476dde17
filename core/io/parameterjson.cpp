// SPDX-License-Identifier: Apache-2.0
#include "core/io/parameterjson.h"

#include "core/base/jsontext.h"

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

Response responseFromJson(json& value) {
  if (value.is_number()) return Response(value.get<double>());
  Response response;
  if (const auto curve = value.find("curve"); curve != value.end()) {
    response.kind = Response::Kind::Curve;
    for (const json& point : *curve) response.points.push_back({point[0].get<double>(), point[1].get<double>()});
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
      for (const api::ResponsePoint& p : response.points) points.push_back({jsonNumber(p.x), jsonNumber(p.y)});
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
