// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/jsontext.h"
#include "core/io/fields.h"

#include <concepts>
#include <memory>
#include <set>
#include <tuple>
#include <variant>

// Kinds of values that a row of a field table may have. Each describes itself (schema), reads what has passed that
// schema, writes, and shows a visitor what it stands for. Private to this room.
namespace ps::fields {

inline constexpr double kFarthest = 1e4;  ///< m, m/s, m/s2: beyond it float32 positions lose the particle

/// A kind that stands for nothing but its value.
struct Plain {
  static constexpr bool kVisited = false;
};
struct Referring {
  static constexpr bool kVisited = true;
};

Json numberSchema(double minimum, double maximum, const char* unit);
Json namesSchema(const std::vector<std::string>& names);
/// A value of any parameter: a switch, a number, a choice, a curve or a law.
Json valueSchema();
/// "#/$defs/NAME".
Json definitionSchema(const char* name);

struct Number : Plain {
  static constexpr bool kHasDefault = true;
  double minimum = 0, maximum = 0;
  const char* unit = "";
  Number(double least, double most, const char* si = "") : minimum(least), maximum(most), unit(si) {}
  Json schema() const { return numberSchema(minimum, maximum, unit); }
  void read(Json& value, double& out, const PluginRegistry&) const { out = value.get<double>(); }
  Json write(double value) const { return jsonNumber(value); }
};

struct Integer : Plain {
  static constexpr bool kHasDefault = true;
  int64_t minimum = 0, maximum = 0;
  Integer(int64_t least, int64_t most) : minimum(least), maximum(most) {}
  Json schema() const { return {{"type", "integer"}, {"minimum", minimum}, {"maximum", maximum}}; }
  template <std::integral Int>
  void read(Json& value, Int& out, const PluginRegistry&) const {
    out = static_cast<Int>(value.get<double>());
  }
  Json write(std::integral auto value) const { return value; }
};

struct Toggle : Plain {
  static constexpr bool kHasDefault = true;
  Json schema() const { return {{"type", "boolean"}}; }
  void read(Json& value, bool& out, const PluginRegistry&) const { out = value.get<bool>(); }
  Json write(bool value) const { return value; }
};

struct Text : Plain {
  int64_t longest = 0;  ///< letters; 0: as long as any text
  Text() = default;
  explicit Text(int64_t most) : longest(most) {}
  Json schema() const {
    Json out{{"type", "string"}};
    if (longest > 0) out["maxLength"] = longest;
    return out;
  }
  void read(Json& value, std::string& out, const PluginRegistry&) const { out = value.get<std::string>(); }
  Json write(const std::string& value) const { return value; }
};

struct Choice : Text {
  static constexpr bool kHasDefault = true;
  std::vector<std::string> names;
  explicit Choice(std::vector<std::string> all) : names(std::move(all)) {}
  Json schema() const { return namesSchema(names); }
};

/// x, y or z as 0, 1, 2.
struct Axis : Plain {
  Json schema() const { return namesSchema({"x", "y", "z"}); }
  void read(Json& value, int& out, const PluginRegistry&) const { out = value.get<std::string>()[0] - 'x'; }
  Json write(int value) const { return std::string(1, static_cast<char>('x' + value)); }
};

/// A colour that matter has of its own, sRGB, as "#rrggbb".
struct ColourText : Text {
  Json schema() const { return {{"type", "string"}, {"pattern", "^#[0-9a-f]{6}$"}}; }
};
/// Something's own name, or that of something else of the scene.
struct Id : Text {
  Json schema() const { return definitionSchema("id"); }
};

struct MaterialId : Id {
  static constexpr bool kVisited = true;
  void visit(const std::string& id, const std::string& pointer, FieldVisitor& visitor) const {
    visitor.material(id, pointer);
  }
};

/// The id of a plugin. `withoutIt` ends the warning that it is missing; nullptr for one that is asked for elsewhere.
struct PluginId : Text {
  static constexpr bool kVisited = true;
  std::optional<PluginKind> kind;
  const char* withoutIt = nullptr;
  PluginId() = default;
  PluginId(std::optional<PluginKind> of, const char* consequence) : kind(of), withoutIt(consequence) {}
  Json schema() const { return definitionSchema("plugin"); }
  void visit(const std::string& id, const std::string& pointer, FieldVisitor& visitor) const {
    if (withoutIt && !id.empty()) visitor.plugin(kind, id, pointer, withoutIt);
  }
};

/// The same, or "" for none.
struct OptionalPluginId : PluginId {
  using PluginId::PluginId;
  Json schema() const {
    return {{"type", "string"}, {"maxLength", 100}, {"pattern", "^([A-Za-z0-9_][A-Za-z0-9_.-]*)?$"}};
  }
};

/// "wall/floor/temperature".
struct AddressText : Text {
  static constexpr bool kVisited = true;
  void visit(const std::string& text, const std::string& pointer, FieldVisitor& visitor) const {
    visitor.address(text, pointer);
  }
};

/// What particles show: a name of the table of fields. The published schema names ours and leaves room for plugins'.
struct ShownName : Text {
  static constexpr bool kVisited = true;
  std::vector<std::string> ours;
  explicit ShownName(std::vector<std::string> names) : Text(200), ours(std::move(names)) {}
  Json schema() const {
    Json out = Text::schema();
    out["anyOf"] = {namesSchema(ours), {{"pattern", "^[a-z0-9_.-]+$"}, {"description", "a field of a plugin"}}};
    return out;
  }
};

/// What colours mean: "material" or a field.
struct ColourName : ShownName {
  static constexpr bool kHasDefault = true;
  using ShownName::ShownName;
  void visit(const std::string& name, const std::string& pointer, FieldVisitor& visitor) const {
    visitor.colour(name, pointer);
  }
};

/// What a probe measures.
struct QuantityName : ShownName {
  using ShownName::ShownName;
  void visit(const std::string& name, const std::string& pointer, FieldVisitor& visitor) const {
    visitor.quantity(name, pointer);
  }
};

struct Vector : Plain {
  static constexpr bool kHasDefault = true;
  const char* unit = "";
  double minimum = -kFarthest;
  explicit Vector(const char* si, double least = -kFarthest) : unit(si), minimum(least) {}
  Json schema() const {
    return {{"type", "array"}, {"items", numberSchema(minimum, kFarthest, unit)}, {"minItems", 3}, {"maxItems", 3}};
  }
  void read(Json& value, Vector3& out, const PluginRegistry&) const { out = vectorFromJson(value); }
  Json write(const Vector3& value) const { return jsonFromVector(value); }
};

/// Any length but zero.
struct Direction : Vector {
  static constexpr bool kVisited = true;
  Direction() : Vector("") {}
  void visit(const Vector3& value, const std::string& pointer, FieldVisitor& visitor) const {
    visitor.direction(value, pointer);
  }
};

/// One toggle for each of x, y and z.
struct AxisToggles : Plain {
  static constexpr bool kHasDefault = true;
  Json schema() const {
    return {{"type", "array"}, {"items", {{"type", "boolean"}}}, {"minItems", 3}, {"maxItems", 3}};
  }
  void read(Json& value, std::array<bool, 3>& out, const PluginRegistry&) const {
    out = value.get<std::array<bool, 3>>();
  }
  Json write(const std::array<bool, 3>& value) const { return value; }
};

/// Numbers at fixed places of a short list, as members of V or elements of an array.
template <class V>
struct Tuple : Plain {
  struct Part {
    Json schema;
    double (*get)(const V&);
    void (*set)(V&, double);
  };
  const char* help = "";
  std::vector<Part> parts;
  size_t needed;  ///< of the first ones; zeros of the others at the end are left out
  Tuple(const char* words, std::vector<Part> all) : help(words), parts(std::move(all)), needed(parts.size()) {}
  Tuple(const char* words, std::vector<Part> all, size_t least) : help(words), parts(std::move(all)), needed(least) {}
  Json schema() const {
    Json items = Json::array();
    for (const Part& part : parts) items.push_back(part.schema);
    return {{"type", "array"},
            {"prefixItems", items},
            {"minItems", needed},
            {"maxItems", parts.size()},
            {"description", help}};
  }
  void read(Json& value, V& out, const PluginRegistry&) const {
    for (size_t i = 0; i < std::min(parts.size(), value.size()); ++i)
      parts[i].set(out, value[i].template get<double>());
  }
  Json write(const V& value) const {
    size_t count = parts.size();
    while (count > needed && parts[count - 1].get(value) == 0) --count;
    Json out = Json::array();
    for (size_t i = 0; i < count; ++i) out.push_back(jsonNumber(parts[i].get(value)));
    return out;
  }
};

template <auto kMember, class V>
typename Tuple<V>::Part memberPart(Integer kind, const char* help = "") {
  Json schema = kind.schema();
  if (*help) schema["description"] = help;
  return {schema, [](const V& v) { return static_cast<double>(v.*kMember); },
          [](V& v, double number) { v.*kMember = static_cast<int>(number); }};
}

template <size_t kIndex, class V>
typename Tuple<V>::Part elementPart(Number kind) {
  return {kind.schema(), [](const V& v) { return v[kIndex]; }, [](V& v, double number) { v[kIndex] = number; }};
}

/// The object of another table. `definition`: its name among the schema's definitions, where it has one.
template <class T>
struct Object : Referring {
  const FieldTable<T>* table;
  const char* definition;
  explicit Object(const FieldTable<T>& fields, const char* name = nullptr) : table(&fields), definition(name) {}
  Json schema() const { return definition ? definitionSchema(definition) : table->schema(); }
  void read(Json& value, T& out, const PluginRegistry& plugins) const { table->read(out, value, plugins); }
  Json write(const T& value) const { return table->write(value); }
  void visit(const T& value, const std::string& pointer, FieldVisitor& visitor) const {
    table->visit(value, pointer, visitor);
  }
};

/// A list of values of one kind. Items that have an id must have different ones.
template <class Kind>
struct List {
  static constexpr bool kVisited = Kind::kVisited;
  Kind item;
  const char* itemHelp = "";
  explicit List(Kind kind, const char* help = "") : item(std::move(kind)), itemHelp(help) {}
  Json schema() const {
    Json out{{"type", "array"}, {"items", item.schema()}};
    if (*itemHelp) out["items"]["description"] = itemHelp;
    return out;
  }
  template <class V>
  void read(Json& value, std::vector<V>& out, const PluginRegistry& plugins) const {
    out.resize(value.size());
    for (size_t i = 0; i < out.size(); ++i) item.read(value[i], out[i], plugins);
  }
  template <class V>
  Json write(const std::vector<V>& list) const {
    Json out = Json::array();
    for (const V& value : list) out.push_back(item.write(value));
    return out;
  }
  template <class V>
  bool isDefault(const std::vector<V>& list) const {
    return list.empty();
  }
  template <class V>
  void visit(const std::vector<V>& list, const std::string& pointer, FieldVisitor& visitor) const {
    std::set<std::string> seen;
    for (size_t i = 0; i < list.size(); ++i) {
      const std::string place = pointer + "/" + std::to_string(i);
      if constexpr (requires { list[i].id; }) {
        if (!seen.insert(list[i].id).second) visitor.repeatedId(list[i].id, place + "/id");
      }
      item.visit(list[i], place, visitor);
    }
  }
};

/// A value that need not be there.
template <class Kind>
struct Optional {
  static constexpr bool kVisited = Kind::kVisited;
  Kind kind;
  explicit Optional(Kind of) : kind(std::move(of)) {}
  Json schema() const { return kind.schema(); }
  template <class V>
  void read(Json& value, std::optional<V>& out, const PluginRegistry& plugins) const {
    kind.read(value, out.emplace(), plugins);
  }
  template <class V>
  Json write(const std::optional<V>& value) const {
    return kind.write(*value);
  }
  template <class V>
  bool isDefault(const std::optional<V>& value) const {
    return !value.has_value();
  }
  template <class V>
  void visit(const std::optional<V>& value, const std::string& pointer, FieldVisitor& visitor) const {
    if (value) kind.visit(*value, pointer, visitor);
  }
};

/// A value that need not be there, and is shared by all copies of its owner: never changed in place.
template <class Kind>
struct Shared {
  static constexpr bool kVisited = Kind::kVisited;
  Kind kind;
  explicit Shared(Kind of) : kind(std::move(of)) {}
  Json schema() const { return kind.schema(); }
  template <class V>
  void read(Json& value, std::shared_ptr<const V>& out, const PluginRegistry& plugins) const {
    auto fresh = std::make_shared<V>();
    kind.read(value, *fresh, plugins);
    out = std::move(fresh);
  }
  template <class V>
  Json write(const std::shared_ptr<const V>& value) const {
    return kind.write(*value);
  }
  template <class V>
  bool isDefault(const std::shared_ptr<const V>& value) const {
    return !value;
  }
  template <class V>
  void visit(const std::shared_ptr<const V>& value, const std::string& pointer, FieldVisitor& visitor) const {
    if (value) kind.visit(*value, pointer, visitor);
  }
};

/// One of several objects, told apart by its key: {"box": {...}} or {"voxels": {...}}.
template <class T>
struct Alternative {
  const char *key, *help;
  const FieldTable<T>* table;
};
template <class... Ts>
struct OneOf : Referring {
  std::tuple<Alternative<Ts>...> all;
  explicit OneOf(Alternative<Ts>... alternatives) : all(alternatives...) {}
  template <class Visit>
  void each(Visit visit) const {
    std::apply([&](const auto&... one) { (visit(one), ...); }, all);
  }
  Json schema() const {
    Json branches = Json::array();
    each([&](const auto& one) {
      branches.push_back({{"type", "object"},
                          {"properties", Json::object({{one.key, one.table->schema()}})},
                          {"required", Json::array({one.key})},
                          {"description", one.help}});
    });
    return {{"oneOf", branches}};
  }
  void read(Json& value, std::variant<Ts...>& out, const PluginRegistry& plugins) const {
    each([&]<class T>(const Alternative<T>& one) {
      const auto found = value.find(one.key);
      if (found == value.end()) return;
      Json inner = std::move(*found);
      value.erase(found);
      one.table->read(out.template emplace<T>(), inner, plugins);
    });
  }
  Json write(const std::variant<Ts...>& value) const {
    Json out;
    each([&]<class T>(const Alternative<T>& one) {
      if (const T* inner = std::get_if<T>(&value)) out[one.key] = one.table->write(*inner);
    });
    return out;
  }
  void visit(const std::variant<Ts...>& value, const std::string& pointer, FieldVisitor& visitor) const {
    each([&]<class T>(const Alternative<T>& one) {
      if (const T* inner = std::get_if<T>(&value)) one.table->visit(*inner, pointer + "/" + one.key, visitor);
    });
  }
};

/// An object of parameters that a list declares.
struct Declared : Referring {
  api::ParameterList (*list)();
  explicit Declared(api::ParameterList (*declarations)()) : list(declarations) {}
  Json schema() const { return parameterListSchema(list()); }
  void read(Json& value, ParameterSet& out, const PluginRegistry&) const { takeParameters(value, out, list()); }
  Json write(const ParameterSet& set) const {
    Json out = Json::object();
    putParameters(out, set);
    return out;
  }
  bool isDefault(const ParameterSet& set) const { return set.values.empty(); }
  void visit(const ParameterSet& set, const std::string& pointer, FieldVisitor& visitor) const {
    visitor.parameters(set, list(), pointer);
  }
};

}  // namespace ps::fields
