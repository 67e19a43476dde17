// SPDX-License-Identifier: Apache-2.0
#include "core/io/projectio.h"

#include "core/base/jsontext.h"
#include "core/io/projectcheck.h"
#include "core/io/schema.h"
#include "core/io/textfile.h"
#include "core/plugin_host/registry.h"

#include <algorithm>
#include <charconv>

namespace ps {
namespace {

using nlohmann::json;

std::vector<std::string> pointerParts(std::string_view pointer) {
  std::vector<std::string> parts(1);
  if (pointer.starts_with('/')) pointer.remove_prefix(1);
  for (size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      parts.emplace_back();
    } else if (pointer[i] == '~' && i + 1 < pointer.size() && (pointer[i + 1] == '0' || pointer[i + 1] == '1')) {
      parts.back() += pointer[++i] == '0' ? '~' : '/';
    } else {
      parts.back() += pointer[i];
    }
  }
  return parts;
}

/// The member or element that a part of a pointer names; nullptr where a list has none.
json* step(json& value, const std::string& part) {
  if (value.is_null()) value = json::object();
  if (value.is_object()) return &value[part];
  if (!value.is_array()) return nullptr;
  for (json& item : value) {
    if (item.is_object() && item.contains("id") && item["id"] == part) return &item;
  }
  size_t index = 0;
  const auto [end, problem] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (problem != std::errc() || end != part.data() + part.size() || index >= value.size()) return nullptr;
  return &value[index];
}

InputError noSuchPlace(const std::string& edit, const std::string& part) {
  return InputError("--set " + edit + ": the project has no '" + part + "' there");
}

json editedValue(const std::string& text, const std::string& edit) {
  try {
    return parseJson(text, edit);
  } catch (const InputError&) {
    if (!text.empty() && (text[0] == '{' || text[0] == '[' || text[0] == '"')) throw;
    return text;
  }
}

/// Format and version speak first: whatever else is wrong follows from them.
void checkFormat(const json& document, const std::string& name) {
  if (!document.is_object()) throw InputError(name + ":/: must be an object in { }: this is no PhaseSketch project");
  const auto format = document.find("format");
  if (format == document.end() || *format != "phasesketch") {
    throw InputError(name + ":/format: must be \"phasesketch\": this is no PhaseSketch project");
  }
  const auto version = document.find("version");
  if (version == document.end() || !version->is_number_integer() || version->get<double>() < 1) return;
  const auto oldest = document.find("minVersion");
  const bool known = oldest != document.end() && oldest->is_number_integer();
  const json& needed = known ? *oldest : *version;
  if (needed.get<double>() > kProjectVersion) {
    throw InputError(name + (known ? ":/minVersion" : ":/version") + ": needs project format " + needed.dump() +
                     ", this program reads up to " + std::to_string(kProjectVersion) + "; update PhaseSketch");
  }
}

std::string whyRequiredFails(const std::string& id, const PluginRegistry& plugins) {
  const std::string plugin = "the plugin '" + id + "' ";
  for (const PluginInfo& info : plugins.plugins()) {
    if (info.id == id && !info.problem.empty()) return plugin + "cannot be used: " + info.problem;
  }
  return plugin + "is not installed; install it, or take it off this list to open the project without it";
}

void checkRequired(const json& document, const std::string& name, const PluginRegistry& plugins) {
  const auto required = document.find("pluginsRequired");
  if (required == document.end()) return;
  for (size_t i = 0; i < required->size(); ++i) {
    const std::string& id = (*required)[i].get_ref<const std::string&>();
    if (plugins.has(id)) continue;
    throw InputError(name + ":/pluginsRequired/" + std::to_string(i) + ": " + whyRequiredFails(id, plugins));
  }
}

/// Checks "parameters" of one owner against what its plugin declares.
void checkParameters(const json& owner, const char* key, const PluginRegistry& plugins, const std::string& name,
                     const std::string& pointer, std::vector<UnknownKey>& unknown) {
  const auto parameters = owner.find("parameters");
  const std::string id = owner.at(key).get<std::string>();
  if (!plugins.has(id) || parameters == owner.end()) return;
  checkAgainst(parameterListSchema(plugins.parameters(id)), *parameters, name, pointer + "/parameters", unknown);
}

void checkPluginParameters(const json& document, const std::string& name, const PluginRegistry& plugins,
                           std::vector<UnknownKey>& unknown) {
  const json &materials = document.at("materials"), &bodies = document.at("bodies");
  for (size_t i = 0; i < materials.size(); ++i) {
    checkParameters(materials[i], "base", plugins, name, "/materials/" + std::to_string(i), unknown);
  }
  for (size_t b = 0; b < bodies.size(); ++b) {
    const std::string pointer = "/bodies/" + std::to_string(b);
    const json constraints = bodies[b].value("constraints", json::array());
    for (size_t c = 0; c < constraints.size(); ++c) {
      checkParameters(constraints[c], "plugin", plugins, name, pointer + "/constraints/" + std::to_string(c), unknown);
    }
    const auto voxels = bodies[b].at("shape").find("voxels");
    if (voxels == bodies[b].at("shape").end() || !voxels->contains("strokes")) continue;
    const json& strokes = voxels->at("strokes");
    for (size_t s = 0; s < strokes.size(); ++s) {
      checkParameters(strokes[s], "brush", plugins, name, pointer + "/shape/voxels/strokes/" + std::to_string(s),
                      unknown);
    }
  }
  const json::json_pointer thermal("/solver/thermal");
  if (document.contains(thermal)) {
    checkParameters(document.at(thermal), "model", plugins, name, thermal.to_string(), unknown);
  }
}

/// Keys that the format has set aside: kept for the program that knows them, and told here, since the scene that opens
/// is not all that the file holds.
void warnReserved(const json& document, const std::string& name, std::vector<ProjectMessage>& warnings) {
  static constexpr std::pair<const char*, const char*> kReserved[] = {
      {"state", "is kept, but this version does not use it: the scene opens at its start"},
      {"tracks", "are kept, but this version does not use them: parameters stay as they stand elsewhere in the file"}};
  for (const auto& [key, what] : kReserved) {
    if (document.contains(key)) warnings.push_back({false, name + ":/" + key + ": " + what});
  }
}

}  // namespace

void applyEdit(json& document, const std::string& edit) {
  const size_t equals = edit.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError("--set " + edit + ": must be json/pointer=value");
  }
  json* place = &document;
  for (const std::string& part : pointerParts(std::string_view(edit).substr(0, equals))) {
    place = step(*place, part);
    if (!place) throw noSuchPlace(edit, part);
  }
  *place = editedValue(edit.substr(equals + 1), "--set " + edit.substr(0, equals));
}

void checkDocument(const json& document, const std::string& name, const PluginRegistry& plugins,
                   std::vector<ProjectMessage>& warnings) {
  checkFormat(document, name);
  std::vector<UnknownKey> unknown;
  checkAgainst(projectSchema(), document, name, "", unknown);
  checkRequired(document, name, plugins);
  checkPluginParameters(document, name, plugins, unknown);
  warnReserved(document, name, warnings);
  for (size_t i = 0; i < std::min(unknown.size(), kMostUnknown); ++i) {
    warnings.push_back({false, name + ":" + unknown[i].pointer + ": is not known here" + unknown[i].meant +
                                   "; it is kept and has no effect"});
  }
  if (unknown.size() > kMostUnknown) {
    warnings.push_back(
        {false, name + ":/: " + std::to_string(unknown.size() - kMostUnknown) + " more keys are not known here"});
  }
}

LoadedProject parseProject(const std::string& text, const std::string& name, const PluginRegistry& plugins,
                           const std::vector<std::string>& edits) {
  json document = parseJson(text, name);
  for (const std::string& edit : edits) applyEdit(document, edit);
  LoadedProject loaded;
  checkDocument(document, name, plugins, loaded.warnings);
  loaded.project = readDocument(document, plugins);
  checkProject(loaded.project, name, plugins, loaded.warnings);
  return loaded;
}

LoadedProject loadProject(const std::string& path, const PluginRegistry& plugins,
                          const std::vector<std::string>& edits) {
  return parseProject(readFile(path, kMaximumProjectBytes), path, plugins, edits);
}

}  // namespace ps
