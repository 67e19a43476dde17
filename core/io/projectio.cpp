// SPDX-License-Identifier: Apache-2.0
#include "core/io/projectio.h"

#include "core/base/jsontext.h"
#include "core/base/utf8.h"
#include "core/io/projectcheck.h"
#include "core/io/projectfields.h"
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

constexpr size_t kShownPointer = 200;  ///< bytes of it that a message repeats

InputError noSuchPlace(const std::string& name, const std::string& part) {
  return InputError(name + ": the project has no '" + shownText(part, kShownPointer) + "' there");
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
  if (version == document.end() || !version->is_number() || version->get<double>() < 1) return;  // the schema says it
  const auto oldest = document.find("minVersion");
  const bool known = oldest != document.end() && oldest->is_number();
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

size_t depthOf(const json& value) {
  size_t deepest = 0;
  if (value.is_structured()) {
    for (const json& item : value) deepest = std::max(deepest, depthOf(item));
    ++deepest;
  }
  return deepest;
}

}  // namespace

void applyEdit(json& document, const std::string& edit) {
  if (utf8Length(edit) < edit.size())
    throw InputError("--set " + shownText(edit, kShownPointer) + ": must be UTF-8 text");
  const size_t equals = edit.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError("--set " + shownText(edit, kShownPointer) + ": must be json/pointer=value");
  }
  const std::vector<std::string> parts = pointerParts(std::string_view(edit).substr(0, equals));
  const std::string name = "--set " + shownText(std::string_view(edit).substr(0, equals), kShownPointer);
  json value = editedValue(edit.substr(equals + 1), name);
  if (parts.size() + depthOf(value) > kMaximumDepth)
    throw InputError(name + ": is nested deeper than " + std::to_string(kMaximumDepth) + " levels");
  json* place = &document;
  for (const std::string& part : parts) {
    place = step(*place, part);
    if (!place) throw noSuchPlace(name, part);
  }
  *place = std::move(value);
}

void checkDocument(const json& document, const std::string& name, const PluginRegistry& plugins,
                   std::vector<ProjectMessage>& warnings) {
  checkFormat(document, name);
  std::vector<UnknownKey> unknown;
  const auto parameters = [&](const std::string& id) {
    return plugins.has(id) ? std::optional(plugins.parameters(id)) : std::nullopt;
  };
  checkAgainstSchema(document, name, parameters, unknown);
  checkRequired(document, name, plugins);
  for (size_t i = 0; i < std::min(unknown.size(), kMostUnknown); ++i) {
    warnings.push_back({false, name + ":" + unknown[i].pointer + ": is not known here" + unknown[i].meant +
                                   "; it is kept and has no effect"});
  }
  if (unknown.size() > kMostUnknown) {
    warnings.push_back(
        {false, name + ":/: " + std::to_string(unknown.size() - kMostUnknown) + " more keys are not known here"});
  }
}

Project readDocument(json& document, const PluginRegistry& plugins) {
  Project project;
  fields::projectFields().read(project, document, plugins);
  for (Body& body : project.bodies) {
    if (auto* solid = std::get_if<SolidShape>(&body.shape)) {
      const auto mesh = std::find_if(project.meshes.begin(), project.meshes.end(),
                                     [&](const auto& one) { return one->id == solid->meshId; });
      if (mesh != project.meshes.end()) solid->mesh = *mesh;
    }
    auto* voxels = std::get_if<VoxelShape>(&body.shape);
    if (voxels && voxels->spacing == 0)
      voxels->spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  }
  return project;
}

LoadedProject readProject(const std::string& text, const std::string& name, const PluginRegistry& plugins,
                          const std::vector<std::string>& edits) {
  json document = parseJson(text, name);
  for (const std::string& edit : edits) applyEdit(document, edit);
  LoadedProject loaded;
  checkDocument(document, name, plugins, loaded.warnings);
  loaded.project = readDocument(document, plugins);
  checkProject(loaded.project, name, plugins, loaded.warnings, loaded.problems);
  return loaded;
}

LoadedProject parseProject(const std::string& text, const std::string& name, const PluginRegistry& plugins,
                           const std::vector<std::string>& edits) {
  LoadedProject loaded = readProject(text, name, plugins, edits);
  if (!loaded.problems.empty()) throw InputError(loaded.problems.front().text);
  return loaded;
}

LoadedProject loadProject(const std::string& path, const PluginRegistry& plugins,
                          const std::vector<std::string>& edits) {
  return parseProject(readFile(path, kMaximumProjectBytes), path, plugins, edits);
}

}  // namespace ps
