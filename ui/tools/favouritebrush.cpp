// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/favouritebrush.h"

#include "core/io/parameterjson.h"
#include "core/plugin_host/registry.h"
#include "core/scene/shownname.h"
#include "ui/document/declared.h"
#include "ui/theme/resources.h"
#include "ui/theme/units.h"

#include <algorithm>
#include <iterator>

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

/// What an object says of what is declared.
ParameterSet valuesIn(const json& object, const api::ParameterList& declared) {
  ParameterSet values;
  for (size_t k = 0; k < declared.count; ++k) {
    if (const auto value = valueIn(object, declared[k])) values.values[declared[k].key] = *value;
  }
  return values;
}

std::string wordIn(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}
json partOf(const json& object, const char* key) { return object.value(key, json::object()); }

/// Those of a list that have a name and a shape.
std::vector<json> namedIn(const QByteArray& text) {
  std::vector<json> named;
  const json list = json::parse(text.begin(), text.end(), nullptr, false);
  if (!list.is_array()) return named;
  std::copy_if(list.begin(), list.end(), std::back_inserter(named), [](const json& one) {
    return one.is_object() && !wordIn(one, "name").empty() && !wordIn(one, "shape").empty();
  });
  return named;
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

BrushSettings taken(const ReadyBrush& ready, BrushSettings inHand, const Project& project) {
  inHand.shape = ready.shape;
  if (materialOf(project, ready.material)) inHand.material = ready.material;
  for (const auto& [key, value] : ready.brush.values) setValueOf(inHand, key, value);
  inHand.parameters[ready.shape] = ready.parameters;
  return inHand;
}

FavouriteBrush renamed(FavouriteBrush favourite, const QString& name) {
  favourite.name = name;
  if (favourite.asKept.isEmpty()) return favourite;
  json kept = json::parse(favourite.asKept.toStdString());
  kept["name"] = name.toStdString();
  favourite.asKept = QByteArray::fromStdString(kept.dump());
  return favourite;
}

QString freeName(const std::vector<FavouriteBrush>& favourites, const QString& name) {
  QString free = name;
  const auto has = [&](const FavouriteBrush& one) { return one.name == free; };
  for (int n = 2; std::any_of(favourites.begin(), favourites.end(), has); ++n)
    free = QStringLiteral("%1 (%2)").arg(name).arg(n);
  return free;
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
  for (const json& one : namedIn(text)) {
    FavouriteBrush favourite{QString::fromStdString(wordIn(one, "name")), {}};
    BrushSettings& brush = favourite.brush;
    brush.shape = wordIn(one, "shape");
    brush.material = wordIn(one, "material");
    for (const auto& [key, value] : valuesIn(partOf(one, "brush"), brushParameters()).values)
      setValueOf(brush, key, value);
    const ParameterSet own = valuesIn(partOf(one, "parameters"), plugins.parameters(brush.shape));
    if (!own.values.empty()) brush.parameters[brush.shape] = own;
    if (!plugins.brush(brush.shape)) favourite.asKept = QByteArray::fromStdString(one.dump());
    favourites.push_back(std::move(favourite));
  }
  return favourites;
}

std::vector<ReadyBrush> readyBrushesOf(const QByteArray& text, const PluginRegistry& plugins) {
  std::vector<ReadyBrush> brushes;
  for (const json& one : namedIn(text)) {
    const std::string shape = wordIn(one, "shape");
    if (!plugins.brush(shape)) continue;
    brushes.push_back({QString::fromStdString(wordIn(one, "name")), QString::fromStdString(wordIn(one, "about")), shape,
                       wordIn(one, "material"), valuesIn(partOf(one, "brush"), brushParameters()),
                       valuesIn(partOf(one, "parameters"), plugins.parameters(shape))});
  }
  return brushes;
}

std::vector<ReadyBrush> readyBrushes(const PluginRegistry& plugins) {
  return readyBrushesOf(themeResource(QStringLiteral("brushes/brushes.json")), plugins);
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
