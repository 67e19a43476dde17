// SPDX-License-Identifier: Apache-2.0
#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/base/nearest.h"
#include "core/io/schema.h"
#include "core/parameters/parameterset.h"

#include <cmath>
#include <limits>
#include <map>
#include <regex>

namespace ps {
namespace {

using nlohmann::json;

bool isType(const json& value, const std::string& type) {
  if (type == "number") return value.is_number();
  if (type == "integer") {
    return value.is_number_integer() ||
           (value.is_number_float() && std::floor(value.get<double>()) == value.get<double>());
  }
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "array") return value.is_array();
  return type == "object" && value.is_object();
}

std::string typeName(const std::string& type) {
  if (type == "integer") return "a whole number";
  if (type == "string") return "text";
  if (type == "boolean") return "true or false";
  if (type == "array") return "a list";
  if (type == "object") return "an object in { }";
  return "a number";
}

/// Patterns are compiled once: that takes longer than all else of a small project.
bool matches(const std::string& pattern, const std::string& text) {
  static thread_local std::map<std::string, std::regex> compiled;  // as many as the schema has
  const auto known = compiled.try_emplace(pattern, pattern).first;
  return std::regex_match(text, known->second);
}

class Checker {
 public:
  Checker(const std::string& name, const PluginParameters& parameters, std::vector<UnknownKey>& unknown)
      : m_name(name), m_parameters(parameters), m_unknown(unknown) {}

  void check(const json& schema, const json& value, const std::string& pointer) const {
    if (const auto ref = schema.find("$ref"); ref != schema.end()) {
      return check(projectSchema().at(json::json_pointer(ref->get<std::string>().substr(1))), value, pointer);
    }
    if (const auto branches = schema.find("oneOf"); branches != schema.end())
      return checkOneOf(*branches, value, pointer);
    if (const auto expected = schema.find("const"); expected != schema.end() && value != *expected) {
      fail(pointer, "must be " + expected->dump() + ", not " + jsonInWords(value));
    }
    if (const auto type = schema.find("type");
        type != schema.end() && !isType(value, type->get_ref<const std::string&>())) {
      const bool name = schema.contains("enum") || schema.contains("pattern");
      fail(pointer,
           "must be " + (name ? "a name" : typeName(type->get<std::string>())) + ", not " + jsonInWords(value));
    }
    if (value.is_number()) checkNumber(schema, value.get<double>(), pointer);
    if (value.is_string()) checkText(schema, value.get_ref<const std::string&>(), pointer);
    if (value.is_array()) checkArray(schema, value, pointer);
    if (value.is_object()) checkObject(schema, value, pointer);
  }

 private:
  [[noreturn]] void fail(const std::string& pointer, const std::string& what) const {
    throw InputError(m_name + ":" + (pointer.empty() ? "/" : pointer) + ": " + what);
  }

  /// By type, then by required keys, so that errors speak of the branch that was meant.
  void checkOneOf(const json& branches, const json& value, const std::string& pointer) const {
    std::string wanted;
    const json* meant = nullptr;
    for (const json& branch : branches) {
      const std::string type = branch.at("type").get<std::string>();
      bool fits = isType(value, type);
      std::string words = typeName(type);
      if (type == "object") {
        const json& key = branch.at("required").at(0);
        words = "an object with " + key.dump();
        fits = fits && value.contains(key.get_ref<const std::string&>());
      }
      wanted += (wanted.empty() ? "" : " or ") + words;
      if (fits && meant) fail(pointer, "must be either " + wanted + ", not both");
      if (fits) meant = &branch;
    }
    if (!meant) fail(pointer, "must be " + wanted + ", not " + jsonInWords(value));
    check(*meant, value, pointer);
  }

  void checkNumber(const json& schema, double value, const std::string& pointer) const {
    const auto minimum = schema.find("minimum"), maximum = schema.find("maximum");
    if (minimum == schema.end() || maximum == schema.end()) return;  // ours come in pairs
    const double least = minimum->get<double>(), most = maximum->get<double>();
    if (value >= least && value <= most) return;
    fail(pointer, rangeProblem(value, least, most, schema.value("x-unit", std::string())));
  }

  void checkText(const json& schema, const std::string& value, const std::string& pointer) const {
    if (const auto names = schema.find("enum"); names != schema.end()) {
      std::string all;
      for (const json& name : *names) {
        if (name == value) return;
        if (!name.get_ref<const std::string&>().empty()) all += (all.empty() ? "" : ", ") + name.get<std::string>();
      }
      fail(pointer, "must be one of " + all + ", not " + jsonInWords(value));
    }
    if (value.size() < schema.value("minLength", size_t{0})) fail(pointer, "must not be empty");
    if (value.size() > schema.value("maxLength", size_t{1'000'000})) fail(pointer, "is too long a text");
    const auto pattern = schema.find("pattern");
    if (pattern == schema.end()) return;
    if (!matches(pattern->get_ref<const std::string&>(), value)) {
      fail(pointer, "must be a name of letters, digits, '_', '.' and '-', not " + jsonInWords(value));
    }
  }

  void checkArray(const json& schema, const json& value, const std::string& pointer) const {
    const auto least = schema.find("minItems"), most = schema.find("maxItems");
    const size_t minimum = least == schema.end() ? 0 : least->get<size_t>();
    const size_t maximum = most == schema.end() ? kMaximumValues : most->get<size_t>();
    if (value.size() < minimum || value.size() > maximum) {
      const std::string count = minimum == maximum       ? std::to_string(minimum)
                                : value.size() < minimum ? "at least " + std::to_string(minimum)
                                                         : "at most " + std::to_string(maximum);
      fail(pointer, "must have " + count + " elements, not " + std::to_string(value.size()));
    }
    const auto items = schema.find("items"), prefix = schema.find("prefixItems");
    std::string place = pointer + "/";
    const size_t stem = place.size();
    for (size_t i = 0; i < value.size(); ++i) {
      place.replace(stem, std::string::npos, std::to_string(i));
      if (prefix != schema.end() && i < prefix->size()) {
        check((*prefix)[i], value[i], place);
      } else if (items != schema.end()) {
        check(*items, value[i], place);
      }
    }
  }

  static std::vector<std::string> absentFrom(const json& value, const json& properties) {
    std::vector<std::string> absent;
    for (const auto& [name, unused] : properties.items()) {
      if (!value.contains(name)) absent.push_back(name);
    }
    return absent;
  }

  void checkObject(const json& schema, const json& value, const std::string& pointer) const {
    for (const json& key : schema.value("required", json::array())) {
      if (!value.contains(key.get_ref<const std::string&>()))
        fail(pointer + "/" + key.get<std::string>(), "is missing");
    }
    const auto properties = schema.find("properties");
    if (properties == schema.end()) return;
    for (const auto& [key, member] : value.items()) {
      const auto known = properties->find(key);
      if (known != properties->end()) {
        const std::string place = pointer + "/" + pointerPart(key);
        check(*known, member, place);
        checkParameters(*known, member, value, place);
      } else if (!key.starts_with("$") && !key.starts_with("x-")) {
        const bool named = m_unknown.size() < kMostUnknown;  // the others are counted
        m_unknown.push_back(
            {pointer + "/" + pointerPart(key), named ? didYouMean(key, absentFrom(value, *properties)) : ""});
      }
    }
  }

  /// Against what the plugin declares that a key beside them names.
  void checkParameters(const json& schema, const json& value, const json& owner, const std::string& pointer) const {
    const auto plugin = schema.find(kPluginKeyword);
    if (plugin == schema.end()) return;
    const auto id = owner.find(plugin->at("key").get_ref<const std::string&>());
    if (id == owner.end() || !id->is_string()) return;
    const auto list = m_parameters(id->get<std::string>());
    if (list) check(parameterListSchema(*list), value, pointer);
  }

  const std::string& m_name;
  const PluginParameters& m_parameters;
  std::vector<UnknownKey>& m_unknown;
};

}  // namespace

void checkAgainstSchema(const json& project, const std::string& name, const PluginParameters& parameters,
                        std::vector<UnknownKey>& unknown) {
  Checker(name, parameters, unknown).check(projectSchema(), project, "");
}

void requireSchema(const json& schema, const json& value, const std::string& name) {
  std::vector<UnknownKey> unknown;
  const PluginParameters none = [](const std::string&) { return std::nullopt; };
  Checker(name, none, unknown).check(schema, value, "");
}

}  // namespace ps
