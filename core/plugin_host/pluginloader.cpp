// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/pluginloader.h"

#include "core/base/error.h"
#include "core/plugin_host/declarations.h"

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
std::string checkCommon(const api::Plugin& plugin, PluginInfo& info) {
  const char* label = plugin.label();
  if (!label || !*label) return "its label is empty";
  info.label = textOrEmpty(label);
  info.help = textOrEmpty(plugin.help());
  return problemOfParameters(plugin.parameters());
}

std::string readMaterial(const PluginInfo& info, LoadedPlugin& loaded) {
  loaded.declared.id = info.id;
  loaded.declared.label = info.label;
  loaded.declared.adheresTo = info.adheresTo;
  const api::MaterialPlugin& plugin = *loaded.materialPlugin;
  if (std::string problem = readProperties(plugin.properties(), loaded.declared); !problem.empty()) return problem;
  if (std::string problem = problemOfProperties(loaded.declared); !problem.empty()) return problem;
  loaded.material = evaluateLaws(plugin, loaded.declared, {});
  return {};
}

std::string connect(QObject& object, PluginInfo& info, LoadedPlugin& loaded) {
  const api::Plugin* plugin = nullptr;
  switch (info.kind) {
    case PluginKind::Material:
      plugin = loaded.materialPlugin = qobject_cast<api::MaterialPlugin*>(&object);
      break;
    case PluginKind::Constraint:
      plugin = loaded.constraint = qobject_cast<api::ConstraintPlugin*>(&object);
      break;
    case PluginKind::Thermal:
      plugin = loaded.thermal = qobject_cast<api::ThermalPlugin*>(&object);
      break;
    case PluginKind::Brush:
      plugin = loaded.brush = qobject_cast<api::BrushPlugin*>(&object);
      break;
  }
  if (!plugin) return std::string("its class lacks Q_INTERFACES for a ") + pluginKindName(info.kind);
  if (std::string problem = checkCommon(*plugin, info); !problem.empty()) return problem;
  if (loaded.constraint) return problemOfTraits(loaded.constraint->traits());
  if (loaded.thermal) return problemOfFields(loaded.thermal->fields());
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

std::vector<double> completed(const std::vector<double>& parameters, api::ParameterList list) {
  std::vector<double> all = parameters;
  for (size_t i = all.size(); i < list.count; ++i) all.push_back(list[i].defaultValue);
  return all;
}

}  // namespace

LoadedPlugin loadLibrary(PluginInfo& info) {
  const NumberFormatGuard guard;
  LoadedPlugin loaded;
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
    }
  } catch (...) {
    problem = "it failed while it was loaded: " + currentExceptionText() + "; " + whomToTell(info);
  }
  if (problem.empty()) return loaded;
  info.problem = info.path + ": " + problem;
  return {};
}

Material evaluateLaws(const api::MaterialPlugin& plugin, Material material, const std::vector<double>& parameters) {
  static const std::vector<double> kTemperatures = lawTemperatures();
  const std::vector<double> values = completed(parameters, plugin.parameters());
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
  return QString::fromStdString(text).toStdString();  // what is not UTF-8 becomes U+FFFD
}

}  // namespace ps
