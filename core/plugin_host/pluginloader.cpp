// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/pluginloader.h"

#include "core/base/callee.h"
#include "core/base/error.h"
#include "core/base/shorttext.h"
#include "core/plugin_host/declarations.h"
#include "core/plugin_host/hostservices.h"

#include <phasesketch/qtentry.h>

#include <QObject>
#include <QPluginLoader>
#include <QString>

#include <clocale>
#include <cmath>
#include <exception>

namespace ps {
namespace {

/// Plugins, and libraries that they bring along, may set the locale from the environment; "1.5" must stay a number.
class NumberFormatGuard {
 public:
  ~NumberFormatGuard() { std::setlocale(LC_NUMERIC, "C"); }
};

std::string textOrEmpty(const char* text) { return text ? oneLine(text) : std::string(); }

/// Reads what all kinds declare.
std::string checkCommon(const api::Plugin& plugin, PluginInfo& info, LoadedPlugin& loaded) {
  const char* label = plugin.label();
  if (!label || !*label) return "its label is empty";
  for (const auto& [name, text] : {std::pair{"label", label}, std::pair{"help", plugin.help()}})
    if (const std::string problem = problemOfText(text); !problem.empty())
      return std::string("its ") + name + " " + problem;
  info.label = textOrEmpty(label);
  info.help = QString::fromUtf8(plugin.help()).simplified().toStdString();
  return readParameters(plugin.parameters(), loaded.parameters);
}

std::string readMaterial(const PluginInfo& info, LoadedPlugin& loaded) {
  loaded.declared.id = info.id;
  loaded.declared.label = info.label;
  loaded.declared.adheresTo = info.adheresTo;
  const api::MaterialPlugin& plugin = *loaded.materialPlugin;
  if (std::string problem = readProperties(plugin.properties(), loaded.declared); !problem.empty()) return problem;
  if (std::string problem = problemOfProperties(loaded.declared); !problem.empty()) return problem;
  loaded.material = evaluateLaws(loaded, loaded.declared, {});
  return {};
}

/// The object as a plugin of one interface, noted; nullptr when it has another.
template <class Interface>
Interface* claimed(QObject& object, const Interface*& place) {
  auto* plugin = qobject_cast<Interface*>(&object);
  place = plugin;
  return plugin;
}

std::string connect(QObject& object, PluginInfo& info, LoadedPlugin& loaded) {
  api::Plugin*& plugin = loaded.plugin;
  switch (info.kind) {
    case PluginKind::Material:
      plugin = claimed<api::MaterialPlugin>(object, loaded.materialPlugin);
      break;
    case PluginKind::Constraint:
      if (api::ConstraintPlugin* constraint = claimed<api::StructuralPlugin>(object, loaded.structural))
        plugin = constraint, loaded.constraint = constraint;
      else if (constraint = claimed<api::GroupPlugin>(object, loaded.group); constraint)
        plugin = constraint, loaded.constraint = constraint;
      else if (constraint = claimed<api::NeighbourPlugin>(object, loaded.neighbour); constraint)
        plugin = constraint, loaded.constraint = constraint;
      break;
    case PluginKind::Thermal:
      plugin = claimed<api::ThermalPlugin>(object, loaded.thermal);
      break;
    case PluginKind::HeatSource:
      plugin = claimed<api::HeatSourcePlugin>(object, loaded.heatSource);
      break;
    case PluginKind::Brush:
      plugin = claimed<api::BrushPlugin>(object, loaded.brush);
      break;
  }
  if (!plugin) return std::string("its class lacks Q_INTERFACES for a ") + pluginKindName(info.kind);
  if (std::string problem = checkCommon(*plugin, info, loaded); !problem.empty()) return problem;
  const FieldOwner owner{info.id, info.own};
  if (loaded.structural) return readTraits(*loaded.structural, owner, loaded.fields);
  if (loaded.group) return readTraits(*loaded.group, owner, loaded.fields);
  if (loaded.neighbour) return readTraits(*loaded.neighbour, owner, loaded.fields);
  if (loaded.thermal) return readFields(loaded.thermal->fields(), owner, loaded.fields);
  if (loaded.heatSource) return readFields(loaded.heatSource->fields(), owner, loaded.fields);
  return loaded.materialPlugin ? readMaterial(info, loaded) : std::string();
}

/// The temperatures at which laws are sampled: every kelvin to 600 K, every ten to 6000 K.
std::vector<double> lawTemperatures() {
  std::vector<double> temperatures;
  for (int t = 1; t < 600; ++t) temperatures.push_back(t);
  for (int t = 600; t <= 6000; t += 10) temperatures.push_back(t);
  return temperatures;
}

/// A curve through samples; inner points of level stretches add nothing and are left out.
Response curveThrough(const std::vector<double>& x, const std::vector<double>& y) {
  Response curve;
  curve.kind = Response::Kind::Curve;
  for (size_t i = 0; i < x.size(); ++i) {
    const bool level = i > 0 && i + 1 < x.size() && y[i] == y[i - 1] && y[i] == y[i + 1];
    if (!level) curve.points.push_back({x[i], y[i]});
  }
  return curve;
}

std::vector<double> completed(const std::vector<double>& parameters,
                              const std::vector<api::ParameterDeclaration>& list) {
  std::vector<double> all = parameters;
  for (size_t i = all.size(); i < list.size(); ++i) all.push_back(list[i].defaultValue);
  return all;
}

}  // namespace

LoadedPlugin loadLibrary(PluginInfo& info, const std::shared_ptr<InstalledMaterials>& materials) {
  const NumberFormatGuard guard;
  const CalleeScope callee(info.id.c_str());
  LoadedPlugin loaded;
  loaded.id = info.id;
  std::string problem;
  try {
    QPluginLoader loader(QString::fromStdString(info.path));
    loader.setLoadHints(QLibrary::ResolveAllSymbolsHint | QLibrary::PreventUnloadHint);
    QObject* object = loader.instance();
    if (!object) {
      problem =
          "it could not be loaded: " + oneLine(loader.errorString().toStdString()) + "; build it again for this system";
    } else if (problem = connect(*object, info, loaded); !problem.empty()) {
      problem += "; " + whomToTell(info);
    } else {
      attach(*loaded.plugin, info.id, materials);
    }
  } catch (...) {
    problem = "it failed while it was loaded: " + currentExceptionText() + "; " + whomToTell(info);
  }
  if (problem.empty()) return loaded;
  info.problem = info.path + ": " + problem;
  return {};
}

Material evaluateLaws(const LoadedPlugin& loaded, Material material, const std::vector<double>& parameters) {
  static const std::vector<double> kTemperatures = lawTemperatures();
  const CalleeScope callee(loaded.id.c_str());
  const std::vector<double> values = completed(parameters, loaded.parameters);
  const api::MaterialPlugin& plugin = *loaded.materialPlugin;
  const api::ParameterList catalogue = propertyCatalogue();
  std::vector<double> out(kTemperatures.size());
  for (size_t i = 0; i < catalogue.count; ++i) {
    if (catalogue[i].kind != api::ParameterKind::Response) continue;
    const std::string key = catalogue[i].key;
    out.assign(out.size(), std::nan(""));  // what a plugin forgets to write is found
    if (!plugin.evaluate(catalogue[i].key, {values.data(), values.size()}, {kTemperatures.data(), kTemperatures.size()},
                         {out.data(), out.size()}))
      continue;
    const Response response = curveThrough(kTemperatures, out);
    if (const std::string problem = problemOfProperty(key, response); !problem.empty())
      throw Error("its law for '" + key + "': " + problem);
    material.properties[key] = response;
  }
  if (const std::string problem = problemOf(material); !problem.empty()) throw Error("property " + problem);
  return material;
}

std::string whomToTell(const PluginInfo& info) {
  return "tell its author" + (info.author.empty() ? std::string() : ", " + oneLine(info.author));
}

std::string currentExceptionText() {
  try {
    throw;
  } catch (const std::exception& e) {
    return oneLine(e.what());
  } catch (...) {
    return "an exception that is no std::exception";
  }
}

std::string oneLine(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  text = shortText(std::move(text));
  return QString::fromStdString(text).toStdString();  // what is not UTF-8 becomes U+FFFD
}

}  // namespace ps
