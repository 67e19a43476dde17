// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/fieldvisitor.h"
#include "core/io/parameterjson.h"
#include "core/io/schema.h"

#include <concepts>
#include <functional>
#include <string>
#include <utility>
#include <vector>

// Each JSON type of a project has one table of fields. Reading, writing, the checks and the published schema all walk
// it, so that a new key is one row:
//
//   field("spin", &Body::spin, Vector{"rad/s"}, "turns about its centre")
//
// Key, member, kind of value (fieldkinds.h: its range, its unit, what it refers to) and help; the default is the
// member's own initialiser. Private to this room.
namespace ps::fields {

using Json = nlohmann::json;

/// One key of T.
template <class T>
struct Field {
  std::string key;
  Json schema;
  Json fallback{};          ///< what absence means, for the schema; null: nothing that it could say
  bool isRequired = false;  ///< a file without it is refused
  bool isAlways = false;    ///< written even where it is the default
  /// Takes what it knows out of `value`; what stays is kept as unknown.
  std::function<void(T&, Json& value, const PluginRegistry&)> read{};
  std::function<Json(const T&)> write{};
  std::function<bool(const T&)> isDefault{};
  std::function<void(T&, const PluginRegistry&)> whenAbsent{};
  std::function<void(const T&, const std::string& pointer, FieldVisitor&)> visit{};

  Field required() && {
    isRequired = isAlways = true;
    return std::move(*this);
  }
  Field always() && {
    isAlways = true;
    return std::move(*this);
  }
  /// What absence means where the rest of the object decides it.
  Field absentMeans(std::function<void(T&, const PluginRegistry&)> set) && {
    whenAbsent = std::move(set);
    return std::move(*this);
  }
  /// When it is left out, where that is not its being the default.
  Field omittedWhen(std::function<bool(const T&)> test) && {
    isDefault = std::move(test);
    return std::move(*this);
  }
  /// What is written in place of the member.
  Field writtenAs(std::function<Json(const T&)> value) && {
    write = std::move(value);
    return std::move(*this);
  }
};

/// All keys of T. They are read, and visited, in the order of the rows.
template <class T>
struct FieldTable {
  const char* help = "";
  std::vector<Field<T>> rows;
  ParameterSet T::*parameters = nullptr;           ///< declared parameters that stand beside the keys
  api::ParameterList (*declarations)() = nullptr;  ///< of them
  Unknown T::*unknown = nullptr;                   ///< where the keys that no row names are kept

  Json schema() const {
    Json out{{"type", "object"}, {"properties", Json::object()}};
    if (*help) out["description"] = help;
    for (const Field<T>& row : rows) {
      Json& property = out["properties"][row.key] = row.schema;
      if (row.isRequired) {
        out["required"].push_back(row.key);
      } else if (!row.fallback.is_null() && !row.whenAbsent) {
        property["default"] = row.fallback;
      }
    }
    if (declarations) addParameterSchemas(out["properties"], declarations());
    return out;
  }

  /// `object` has passed the schema; what is left in it is what no row names and T has no place for.
  void read(T& out, Json& object, const PluginRegistry& plugins) const {
    for (const Field<T>& row : rows) {
      const auto found = object.find(row.key);
      if (found == object.end()) {
        if (row.whenAbsent) row.whenAbsent(out, plugins);
        continue;
      }
      Json value = std::move(*found);
      object.erase(found);
      row.read(out, value, plugins);
      if (value.is_object() && !value.empty()) object[row.key] = std::move(value);
    }
    if (declarations) takeParameters(object, out.*parameters, declarations());
    if (!unknown || object.empty()) return;
    out.*unknown = std::make_shared<const Json>(std::move(object));
    object = Json::object();
  }

  Json write(const T& value) const {
    Json out = Json::object();
    for (const Field<T>& row : rows) {
      if (row.write && (row.isAlways || !row.isDefault(value))) out[row.key] = row.write(value);
    }
    if (parameters) putParameters(out, value.*parameters);
    if (unknown) putUnknown(out, value.*unknown);
    return out;
  }

  void visit(const T& value, const std::string& pointer, FieldVisitor& visitor) const {
    for (const Field<T>& row : rows) {
      if (row.visit) row.visit(value, pointer + "/" + row.key, visitor);
    }
    if (parameters) visitor.parameters(value.*parameters, declarations(), pointer);
    if constexpr (requires { visitor.object(value, pointer); }) visitor.object(value, pointer);
  }
};

/// A row. `Kind` says how a V is read, written, described and visited.
template <class T, class V, class Kind>
Field<T> field(const char* key, V T::*member, Kind kind, const char* help) {
  Field<T> row{key, kind.schema()};
  if (*help) row.schema["description"] = help;
  if constexpr (requires { Kind::kHasDefault; }) row.fallback = kind.write(T{}.*member);
  row.read = [member, kind](T& out, Json& value, const PluginRegistry& plugins) {
    kind.read(value, out.*member, plugins);
  };
  row.write = [member, kind](const T& owner) { return kind.write(owner.*member); };
  if constexpr (requires(const V& v) { kind.isDefault(v); }) {
    row.isDefault = [member, kind](const T& owner) { return kind.isDefault(owner.*member); };
  } else if constexpr (requires(const V& v) {
                         { v == v } -> std::convertible_to<bool>;
                       }) {
    row.isDefault = [member, fallback = T{}.*member](const T& owner) { return owner.*member == fallback; };
  }
  if constexpr (Kind::kVisited) {
    row.visit = [member, kind](const T& owner, const std::string& pointer, FieldVisitor& visitor) {
      kind.visit(owner.*member, pointer, visitor);
    };
  }
  return row;
}

/// An object in the file whose keys are members of T itself.
template <class T>
Field<T> group(const char* key, FieldTable<T> table) {
  Field<T> row{key, table.schema()};
  row.read = [table](T& out, Json& value, const PluginRegistry& plugins) { table.read(out, value, plugins); };
  row.write = [table](const T& owner) { return table.write(owner); };
  row.isDefault = [table](const T& owner) { return table.write(owner) == table.write(T{}); };
  row.visit = [table](const T& owner, const std::string& pointer, FieldVisitor& visitor) {
    for (const Field<T>& inner : table.rows) {
      if (inner.visit) inner.visit(owner, pointer + "/" + inner.key, visitor);
    }
  };
  return row;
}

/// A row of a part that T need not have, as a key of T itself: the part is there when one of its keys is.
template <class T, class Part>
Field<T> within(std::optional<Part> T::*member, Field<Part> row) {
  Field<T> outer{row.key, row.schema};
  outer.read = [=](T& out, Json& value, const PluginRegistry& plugins) {
    std::optional<Part>& part = out.*member;
    row.read(part ? *part : part.emplace(), value, plugins);
  };
  outer.write = [=](const T& owner) { return row.write(*(owner.*member)); };
  outer.isDefault = [=](const T& owner) { return !(owner.*member); };
  return outer;
}

/// "parameters": those that a plugin declares, the one that the row `pluginKey` (a row before it) names.
template <class T>
Field<T> pluginParameters(ParameterSet T::*set, const char* pluginKey, std::string T::*plugin, PluginKind kind,
                          const char* help) {
  Field<T> row{"parameters",
               {{"type", "object"},
                {"description", help},
                {kPluginKeyword, {{"kind", pluginKindName(kind)}, {"key", pluginKey}}}}};
  row.read = [=](T& out, Json& value, const PluginRegistry& plugins) {
    takeParameters(value, out.*set, plugins.parameters(out.*plugin));
  };
  row.write = [=](const T& owner) {
    Json out = Json::object();
    putParameters(out, owner.*set);
    return out;
  };
  row.isDefault = [=](const T& owner) { return (owner.*set).values.empty(); };
  row.visit = [=](const T& owner, const std::string& pointer, FieldVisitor& visitor) {
    visitor.pluginParameters(owner.*plugin, owner.*set, pointer);
  };
  return row;
}

}  // namespace ps::fields
