// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/error.h"
#include "core/scene/project.h"

#include <functional>
#include <string>
#include <vector>

namespace ps {

class PluginRegistry;

struct ProjectMessage {
  bool error = false;    ///< warnings let the project open
  std::string text;      ///< "file:/json/pointer: what is wrong"
  std::string plugin{};  ///< id of the one that is missing, where that is what it says
};

struct LoadedProject {
  Project project;
  std::vector<ProjectMessage> warnings;
  std::vector<ProjectMessage> problems;  ///< why no scene can be made of it: see readProject()
};

/// Reads and checks a project. Throws InputError with "file:/json/pointer: what is wrong" for the first thing wrong:
/// not a file, not JSON, nesting deeper than 64, duplicate keys, NaN, wrong types, values out of hard ranges, unknown
/// references, plugins required and missing. Missing plugins in pluginsUsed only are warnings.
/// `edits`: "json/pointer=value" pairs applied to the JSON before it is checked (--set).
LoadedProject loadProject(const std::string& path, const PluginRegistry& plugins,
                          const std::vector<std::string>& edits = {});
LoadedProject parseProject(const std::string& text, const std::string& name, const PluginRegistry& plugins,
                           const std::vector<std::string>& edits = {});
/// The same for who can mend it: contradicting values, laws that fail, and matter that does not fit are told under
/// `problems`, and the project is there as the file has it.
LoadedProject readProject(const std::string& text, const std::string& name, const PluginRegistry& plugins,
                          const std::vector<std::string>& edits = {});
/// Sorted keys, two spaces, shortest round-trip numbers, newline at the end: load, save, load gives the same bytes.
std::string writeProject(const Project& project);
/// Ids, sorted, of the plugins that the file names itself and of those that the scene refers to.
std::vector<std::string> usedPlugins(const Project& project);
/// Hash of what a run of the project follows from: of all but what people look at, a run's end and who wrote the file.
std::string sceneHash(const Project& project);
/// Unknown keys are kept at every level. Throws Error for a value that is not finite.
/// Atomic: the old file stays until the new one is complete. Throws Error (full disk, no permission).
void saveProject(const Project& project, const std::string& path);

}  // namespace ps
