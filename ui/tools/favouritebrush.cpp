// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/favouritebrush.h"

#include "core/io/parameterjson.h"
#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "ui/document/declared.h"
#include "ui/theme/units.h"

#include <algorithm>
#include <string_view>

namespace ps {
namespace {

using nlohmann::json;

/// A number within the declaration's bounds, a toggle, or one of its choices; nothing where it is none of them.
std::optional<Value> valueIn(const json& object, const api::ParameterDeclaration& declared) {
  const auto found = object.is_object() ? object.find(declared.key) : object.end();
  if (found == object.end()) return std::nullopt;
  if (declared.kind == api::ParameterKind::Toggle) {
    if (found->is_boolean()) return found->get<bool>();
  } else if (declared.kind == api::ParameterKind::Choice) {
    const std::vector<std::string> choices = choicesOf(declared);
    if (found->is_string() && std::find(choices.begin(), choices.end(), found->get<std::string>()) != choices.end())
      return found->get<std::string>();
  } else if (found->is_number()) {
    const double number = found->get<double>();
    if (number >= declared.hardMinimum && number <= declared.hardMaximum) return number;
  }
  return std::nullopt;
}

const SceneMaterial* materialOf(const Project& project, const std::string& id) {
  const auto found = std::find_if(project.materials.begin(), project.materials.end(),
                                  [&](const SceneMaterial& material) { return material.id == id; });
  return found == project.materials.end() ? nullptr : &*found;
}

}  // namespace

FavouriteBrush favouriteOf(const BrushSettings& brush, const PluginRegistry& plugins, const Project& project) {
  FavouriteBrush favourite{{}, brush};
  std::erase_if(favourite.brush.parameters, [&](const auto& own) { return own.first != brush.shape; });
  QStringList parts{pluginLabel(&plugins, brush.shape), lengthText(brush.radius)};
  if (!plugins.needs(brush.shape, api::kTouchesMatter) && !plugins.needs(brush.shape, api::kSmoothsMatter)) {
    if (const SceneMaterial* material = materialOf(project, brush.material))
      parts << QString::fromStdString(shownName(*material));
    if (!plugins.needs(brush.shape, api::kPaintsMatter)) parts << temperatureText(brush.temperature, 0);
  }
  favourite.name = parts.join(QStringLiteral(", "));
  return favourite;
}

BrushSettings taken(const FavouriteBrush& favourite, BrushSettings inHand, const Project& project) {
  BrushSettings brush = favourite.brush;
  if (!materialOf(project, brush.material)) brush.material = inHand.material;
  std::map<std::string, ParameterSet> parameters = std::move(inHand.parameters);
  parameters[brush.shape] = favourite.brush.shapeParameters();
  brush.parameters = std::move(parameters);
  return brush;
}

QByteArray textOf(const std::vector<FavouriteBrush>& favourites) {
  json list = json::array();
  for (const FavouriteBrush& favourite : favourites) {
    if (!favourite.asKept.isEmpty()) {
      list.push_back(json::parse(favourite.asKept.toStdString()));
      continue;
    }
    json one{{"name", favourite.name.toStdString()},
             {"shape", favourite.brush.shape},
             {"material", favourite.brush.material},
             {"brush", json::object()},
             {"parameters", json::object()}};
    putParameters(one["brush"], valuesOf(favourite.brush));
    putParameters(one["parameters"], favourite.brush.shapeParameters());
    list.push_back(std::move(one));
  }
  return QByteArray::fromStdString(list.dump(-1, ' ', false, json::error_handler_t::replace));
}

std::vector<FavouriteBrush> favouritesOf(const QByteArray& text, const PluginRegistry& plugins) {
  std::vector<FavouriteBrush> favourites;
  const json list = json::parse(text.begin(), text.end(), nullptr, false);
  if (!list.is_array()) return favourites;
  const auto word = [](const json& one, const char* key) {
    const auto found = one.find(key);
    return found != one.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  for (const json& one : list) {
    if (!one.is_object()) continue;
    FavouriteBrush favourite{QString::fromStdString(word(one, "name")), {}};
    BrushSettings& brush = favourite.brush;
    brush.shape = word(one, "shape");
    brush.material = word(one, "material");
    if (favourite.name.isEmpty() || brush.shape.empty()) continue;
    const auto part = [&](const char* key) { return one.value(key, json::object()); };
    const json common = part("brush"), own = part("parameters");
    const api::ParameterList shared = brushParameters(), shapes = plugins.parameters(brush.shape);
    for (size_t k = 0; k < shared.count; ++k) {
      if (const auto value = valueIn(common, shared[k])) setValueOf(brush, shared[k].key, *value);
    }
    for (size_t k = 0; k < shapes.count; ++k) {
      if (const auto value = valueIn(own, shapes[k])) brush.parameters[brush.shape].values[shapes[k].key] = *value;
    }
    if (!plugins.brush(brush.shape)) favourite.asKept = QByteArray::fromStdString(one.dump());
    favourites.push_back(std::move(favourite));
  }
  return favourites;
}

std::string textOf(const BrushSettings& brush) {
  const QString inHand = QStringLiteral("in hand");
  std::vector<FavouriteBrush> shapes;
  for (const auto& [shape, own] : brush.parameters) {
    FavouriteBrush other{inHand, brush};
    other.brush.shape = shape;
    if (shape != brush.shape) shapes.push_back(std::move(other));
  }
  shapes.push_back({inHand, brush});
  return textOf(shapes).toStdString();
}

BrushSettings brushOf(const std::string& text, BrushSettings inHand, const PluginRegistry& plugins,
                      const Project& project) {
  const std::string before = inHand.shape;
  for (const FavouriteBrush& favourite : favouritesOf(QByteArray::fromStdString(text), plugins)) {
    if (plugins.brush(favourite.brush.shape))
      inHand = taken(favourite, std::move(inHand), project);
    else
      inHand.shape = before;
  }
  return inHand;
}

}  // namespace ps
