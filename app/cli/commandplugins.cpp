// SPDX-License-Identifier: Apache-2.0
#include "app/cli/arguments.h"
#include "app/cli/commands.h"
#include "app/cli/plugintrial.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/matter/material.h"
#include "core/parameters/wording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/particlefield.h"

#include <algorithm>
#include <cstdio>

namespace ps::cli {
namespace {

using nlohmann::json;

constexpr OptionSpec kOptions[] = {
    {"--json", "", "as JSON, with the declared parameters and the catalogue of material properties"},
    {"--fields", "",
     "lists what particles show, ours and plugins', for colours, probes (but phase and body) and recordings"},
    {"--allow", "ID", "tries a plugin once more, and takes it out of quarantine when it can be loaded"},
    {"--check", "FILE", "tries one plugin in a process of its own and says what is wrong with it, or that it is fine"},
    kPatience,
};

const char* kindName(api::ParameterKind kind) {
  static constexpr const char* kNames[] = {"number", "integer", "toggle", "choice", "response"};
  return kNames[static_cast<size_t>(kind)];
}

json jsonOf(const api::ParameterDeclaration& d) {
  json out{{"key", d.key},   {"label", d.label},         {"symbol", d.symbol},
           {"unit", d.unit}, {"kind", kindName(d.kind)}, {"group", d.group},
           {"help", d.help}, {"example", d.example},     {"source", d.source}};
  if (d.kind == api::ParameterKind::Choice) {
    out["choices"] = choicesOf(d);
    out["default"] = choicesOf(d).at(static_cast<size_t>(d.defaultValue));
  } else if (d.kind == api::ParameterKind::Toggle) {
    out["default"] = d.defaultValue != 0;
  } else {
    out["default"] = jsonNumber(d.defaultValue);
    out["range"] = {jsonNumber(d.minimum), jsonNumber(d.maximum)};
    out["hard_range"] = {jsonNumber(d.hardMinimum), jsonNumber(d.hardMaximum)};
  }
  if (d.enabledWhen) out["enabled_when"] = d.enabledWhen;
  if (d.relations) out["relations"] = d.relations;
  out["acts_at"] = actsAtName(d.actsAt);
  return out;
}

json jsonOf(api::ParameterList list) {
  json out = json::array();
  for (size_t i = 0; i < list.count; ++i) out.push_back(jsonOf(list[i]));
  return out;
}

json jsonOf(const PluginRegistry& plugins, const PluginInfo& info) {
  json out{{"id", info.id},         {"kind", pluginKindName(info.kind)},
           {"label", info.label},   {"version", info.version},
           {"api", info.api},       {"licence", info.licence},
           {"author", info.author}, {"help", info.help},
           {"path", info.path},     {"capabilities", info.capabilities},
           {"json", info.json},     {"state", pluginStateName(info.state)}};
  if (!info.tags.empty()) out["tags"] = info.tags;
  if (!info.problem.empty()) out["problem"] = info.problem;
  if (!info.note.empty()) out["note"] = info.note;
  if (info.state == PluginInfo::State::Loaded) out["parameters"] = jsonOf(plugins.parameters(info.id));
  return out;
}

std::string padded(std::string text, size_t width) {
  text.resize(std::max(text.size() + 2, width), ' ');
  return text;
}

/// One line per plugin, however long its problem is.
void print(const PluginInfo& info) {
  std::string line = padded(info.id.empty() ? "?" : info.id, 24) + padded(pluginKindName(info.kind), 12) +
                     padded(info.version.empty() ? "-" : info.version, 10) + padded(pluginStateName(info.state), 13);
  line += info.problem.empty() ? (info.note.empty() ? info.label : info.note) : info.problem;
  if (!info.problem.empty() && info.problem.find(info.path) == std::string::npos) line += " (" + info.path + ")";
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::printf("%s\n", line.c_str());
}

json jsonOf(const ParticleField& field) {
  json out{{"name", field.name}, {"label", field.label}, {"unit", field.unit}, {"help", field.help}};
  if (field.hasScale()) out["scale"] = {jsonNumber(field.minimum), jsonNumber(field.maximum)};
  return out;
}

void print(const ParticleField& field) {
  const std::string unit = field.unit == "1" ? "" : ", " + field.unit;
  const std::string words = field.label + unit + (field.help.empty() ? "" : ": " + field.help);
  std::printf("%s%s\n", padded(field.name, 32).c_str(), words.c_str());
}

}  // namespace

std::string pluginsHelp() {
  return "phasesketch-cli plugins [options]\n\nLists plugins that were found; PHASESKETCH_PLUGIN_PATH names further "
         "folders.\n\n" +
         optionHelp(kOptions);
}

int pluginsCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  if (!arguments.positional().empty()) throw InputError("unknown argument '" + arguments.positional()[0] + "'");
  if (arguments.has("--check")) return tryPlugin(arguments.text("--check"), patienceOf(arguments));
  watchPlugins(arguments);
  PluginRegistry plugins;
  if (arguments.has("--allow")) {
    const std::string id = arguments.text("--allow");
    const PluginRegistry::SecondTry again = plugins.tryAgain(id);
    if (!again.known) throw InputError("--allow: no plugin '" + id + "' is in quarantine");
    if (!again.problem.empty()) throw Error(again.problem);
    std::printf("%s is loaded again at the next start\n", id.c_str());
    return kFine;
  }
  const ParticleFields fields(plugins);
  if (arguments.has("--fields") && !arguments.has("--json")) {
    for (const FieldPtr& field : fields.all()) print(*field);
    return kFine;
  }
  if (!arguments.has("--json")) {
    for (const PluginInfo& info : plugins.plugins()) print(info);
    return kFine;
  }
  json out{{"plugins", json::array()}, {"properties", jsonOf(propertyCatalogue())}, {"fields", json::array()}};
  for (const FieldPtr& field : fields.all()) out["fields"].push_back(jsonOf(*field));
  for (const PluginInfo& info : plugins.plugins()) out["plugins"].push_back(jsonOf(plugins, info));
  std::fputs(writeJson(out).c_str(), stdout);
  return kFine;
}

}  // namespace ps::cli
