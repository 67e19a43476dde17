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
  JsonTaker taker(value);
  Response response;
  if (taker.has("curve")) {
    response.kind = Response::Kind::Curve;
    for (const json& point : taker.take("curve")) {
      response.points.push_back({point[0].get<double>(), point[1].get<double>()});
    }
  } else {
    response.kind = Response::Kind::Law;
    response.law = taker.text("law");
    for (const json& c : taker.take("coefficients")) response.coefficients.push_back(c.get<double>());
  }
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

json JsonTaker::take(const std::string& key) {
  const auto found = m_object.find(key);
  if (found == m_object.end()) return nullptr;
  json value = std::move(*found);
  m_object.erase(found);
  return value;
}

std::string JsonTaker::text(const char* key, const std::string& fallback) {
  return has(key) ? take(key).get<std::string>() : fallback;
}

double JsonTaker::number(const char* key, double fallback) { return has(key) ? take(key).get<double>() : fallback; }

bool JsonTaker::toggle(const char* key, bool fallback) { return has(key) ? take(key).get<bool>() : fallback; }

Vector3 JsonTaker::vector(const char* key, const Vector3& fallback) {
  if (!has(key)) return fallback;
  const json v = take(key);
  return {v[0].get<double>(), v[1].get<double>(), v[2].get<double>()};
}

std::vector<std::string> JsonTaker::names(const char* key) {
  return has(key) ? take(key).get<std::vector<std::string>>() : std::vector<std::string>();
}

void JsonTaker::keep(const std::string& key, json&& rest) {
  if (!rest.is_null() && !rest.empty()) m_object[key] = std::move(rest);
}

void JsonTaker::parameters(ParameterSet& set, api::ParameterList list) {
  for (size_t i = 0; i < list.count; ++i) {
    const api::ParameterDeclaration& declaration = list[i];
    if (!has(declaration.key)) continue;
    json value = take(declaration.key);
    set.values[declaration.key] = valueFromJson(value, declaration);
    if (value.is_object()) keep(declaration.key, std::move(value));
  }
}

void JsonTaker::parameters(const char* key, ParameterSet& set, api::ParameterList list) {
  if (!has(key)) return;
  json inner = take(key);
  JsonTaker(inner).parameters(set, list);
  keep(key, std::move(inner));
}

Unknown JsonTaker::rest() {
  if (m_object.empty()) return nullptr;
  return std::make_shared<const json>(std::move(m_object));
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

void putParameters(json& object, const ParameterSet& set) {
  for (const auto& [key, value] : set.values) object[key] = jsonFromValue(value);
}

void putUnknown(json& target, const Unknown& unknown) {
  if (unknown && unknown->is_object()) merge(target, *unknown);
}

}  // namespace ps
