// SPDX-License-Identifier: Apache-2.0
#include "app/cli/arguments.h"
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/io/projectio.h"
#include "core/io/recording.h"
#include "core/io/schema.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/packedframe.h"
#include "core/simulation/sceneneed.h"

#include <algorithm>
#include <cstdio>

namespace ps::cli {
namespace {

constexpr OptionSpec kOptions[] = {
    kPatience,
    {"--quiet", "", "says nothing about projects that are fine, and no warnings"},
};

/// One line, whatever the file's name holds.
void say(FILE* stream, std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::fprintf(stream, "%s\n", text.c_str());
  std::fflush(stream);  // a plugin of the next project may never return
}

/// What this machine cannot do; another may.
std::vector<std::string> memoryWarnings(const Project& project, const PluginRegistry& plugins) {
  const Memory memory = memoryNow();
  const std::string problem = memoryProblem(project, &plugins, scaleOf(project), memory);
  if (!problem.empty()) return {"/solver/particle_spacing: " + problem};
  const SceneNeed need = needOf(project, &plugins);
  if (need.bytes + need.pouredBytes <= roomFor(memory)) return {};
  return {"/emitters: they may pour " + particlesText(need.pouredParticles) + ", which take about " +
          memoryText(need.pouredBytes) + " of memory, and this machine has " +
          memoryText(roomFor(memory) - need.bytes) + " for it; they wait while it is full; lower their 'most'"};
}

/// Every frame and state of a recording is unpacked: what is damaged is found.
void validateRecording(const std::string& path, const PluginRegistry& plugins, bool quiet) {
  const RecordingReader recording(path, plugins);
  parseProject(recording.projectText(), path, plugins);
  if (!recording.damage().empty()) throw InputError(recording.damage());
  for (size_t frame = 0; frame < recording.frameCount(); ++frame) recording.frame(frame);
  const KeptRun& run = recording.content().present;
  for (const KeptRun::State& state : run.states) {
    try {
      state.stream->unpacked();
    } catch (const InputError& problem) {
      throw InputError(path + ": the state of frame " + std::to_string(state.frame) + ": " + problem.what());
    }
  }
  if (quiet) return;
  if (!recording.whyNoStates().empty()) say(stderr, "warning: " + recording.whyNoStates());
  char span[80] = "";
  if (!run.frames.empty())
    std::snprintf(span, sizeof span, ", %.6g to %.6g s", run.frames.begin()->second->stats.time,
                  run.frames.rbegin()->second->stats.time);
  say(stdout, path + ": a recording of " + counted(run.frames.size(), "frame") + span + ", " +
                  counted(run.states.size(), "state") + ", " +
                  counted(recording.content().earlier.size(), "earlier run"));
}

}  // namespace

std::string validateHelp() {
  return "phasesketch-cli validate PROJECT|RECORDING... [options]\n\nChecks projects and says file:json/pointer: what "
         "is wrong, and recordings frame by frame. Exit code 2 when one cannot be opened.\n\n" +
         optionHelp(kOptions);
}

int validateCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  if (arguments.positional().empty()) throw InputError("which project? --help says more");
  const bool quiet = arguments.has("--quiet");
  watchPlugins(arguments);
  PluginRegistry plugins;
  int code = kFine;
  for (const std::string& path : arguments.positional()) {
    try {
      if (isRecording(path)) {
        validateRecording(path, plugins, quiet);
        continue;
      }
      LoadedProject loaded = loadProject(path, plugins);
      const std::vector<std::string> memory = memoryWarnings(loaded.project, plugins);
      for (const std::string& text : memory) loaded.warnings.push_back({false, path + ":" + text});
      if (loaded.project.state && memory.empty()) {  // only who goes on from it knows whether it can be
        const Engine engine(loaded.project, plugins);
        for (const std::string& remark : engine.remarks()) loaded.warnings.push_back({false, path + ":" + remark});
      }
      if (quiet) continue;
      for (const ProjectMessage& warning : loaded.warnings) say(stderr, "warning: " + warning.text);
      const size_t count = loaded.warnings.size();
      say(stdout, path + (count == 0 ? ": fine" : ": can be opened, with " + counted(count, "warning")));
    } catch (const InputError& error) {
      say(stderr, error.what());
      code = kBadInput;
    }
  }
  return code;
}

std::string schemaHelp() {
  return "phasesketch-cli schema\n\nPrints the JSON Schema (draft 2020-12) of projects, made from the declarations of "
         "this program's parameters.\n";
}

int schemaCommand(CommandArguments list) {
  const Arguments arguments(list, {});
  if (!arguments.positional().empty()) throw InputError("schema takes no arguments");
  std::fputs(writeJson(projectSchema()).c_str(), stdout);
  return kFine;
}

}  // namespace ps::cli
