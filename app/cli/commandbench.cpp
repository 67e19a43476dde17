// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/experiments/bench.h"
#include "core/io/outputfile.h"
#include "core/plugin_host/registry.h"
#include "core/solver/solver.h"

#include <cstdio>
#include <filesystem>

namespace ps::cli {
namespace {

using nlohmann::json;

constexpr OptionSpec kOptions[] = {
    {"--particles", "N", "scales every scene to about so many particles, by its spacing"},
    {"--frames", "N", "frames to measure, after 10 to warm up; without it 240"},
    kThreads,
    kIsa,
    kPatience,
    {"--json", "FILE", "writes machine, calibration and scenes"},
};

/// A file, or the name of a sample project.
std::string sceneFile(const std::string& name) {
  if (std::filesystem::exists(name)) return name;
  std::error_code problem;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", problem).parent_path();
  for (const std::filesystem::path& folder :
       {std::filesystem::path(PS_SOURCE_PROJECTS), program / "../share/phasesketch/projects"}) {
    const std::filesystem::path file = folder / (name + ".json");
    if (std::filesystem::exists(file, problem)) return file.string();
  }
  throw InputError(name + ": neither a file nor a sample project nor 'tank'");
}

void printDrag(const json& row) {
  std::printf(
      "%-20s %8zu particles  %2d threads  %7.2f ms per frame (p95 %.2f)  %6.1f frames/s, %.1f left alone: "
      "%.1f %% kept  %.0f edits/s  %.3f ms per edit in all, where one table takes %.3f ms\n",
      "drag", row["particles"].get<size_t>(), row["threads"].get<int>(), row["ms"]["median"].get<double>(),
      row["ms"]["p95"].get<double>(), row["frames_per_s"].get<double>(), row["frames_per_s_alone"].get<double>(),
      100 * row["frames_kept"].get<double>(), row["edits_per_s"].get<double>(), row["edit_ms"].get<double>(),
      row["bake_ms"].get<double>());
  std::fflush(stdout);
}

void print(const json& scene) {
  const double milliseconds = scene["ms"]["median"];
  std::printf("%-20s %8zu particles  %2d threads  %7.2f ms per frame (p95 %.2f)  %6.1f frames/s  %.2f ns per pair\n",
              scene["name"].get<std::string>().c_str(), scene["particles"].get<size_t>(), scene["threads"].get<int>(),
              milliseconds, scene["ms"]["p95"].get<double>(), milliseconds > 0 ? 1000 / milliseconds : 0,
              scene["ns_per_pair"].get<double>());
  const json& state = scene["state"];
  std::printf(
      "%-20s %8.0f bytes per particle, saved in %.1f ms, restored in %.1f ms, ready to roll back in %.2f ms, "
      "%.1f %% of a frame\n",
      "  state", state["bytes_per_particle"].get<double>(), state["save_ms"].get<double>(),
      state["restore_ms"].get<double>(), state["rollback_ms"].get<double>(),
      100 * state["rollback_share"].get<double>());
  std::fflush(stdout);
}

}  // namespace

std::string benchHelp() {
  return "phasesketch-cli bench [SCENE...] [options]\n\nMeasures the path that simulate runs. A scene is a project "
         "file, which begins at its start, the name of a sample, 'tank', water at\nrest, or 'drag', the tank while a "
         "slider is dragged at 250 "
         "edits a second, beside the same left alone; without one:\nice-on-hot-plate, tank and drag. iterations are "
         "those of a "
         "whole frame; ns_per_pair is the density stage over\nordered pairs within the support.\n\n" +
         optionHelp(kOptions);
}

int benchCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  const auto particles = arguments.integer("--particles", 8, 10'000'000);
  const long frames = arguments.integer("--frames", 1, 1'000'000).value_or(240);
  requireOutputs(arguments, arguments.positional(), {"--json"});
  applyMachineOptions(arguments);
  std::vector<std::string> names = arguments.positional();
  if (names.empty()) names = {"ice-on-hot-plate", "tank", "drag"};
  PluginRegistry plugins;
  json out{{"machine", benchMachine()}, {"calibration", benchCalibration(plugins)}, {"scenes", json::array()}};
  for (const std::string& name : names) {
    if (name == "drag") {
      out["scenes"].push_back(benchDrag(static_cast<int>(particles.value_or(100000)), plugins, frames / 4));
      printDrag(out["scenes"].back());
      continue;
    }
    Project project;
    if (name == "tank") {
      project = tank(static_cast<int>(particles.value_or(20000)));
    } else {
      const std::string file = sceneFile(name);
      project = loadProject(file, plugins).project;
      project.state = nullptr;  // figures of a scene are compared with those of another day
      if (particles) scaleTo(project, *particles, Engine(project, plugins).particles().size());
    }
    out["scenes"].push_back(benchScene(name, project, plugins, frames).result);
    print(out["scenes"].back());
  }
  if (arguments.has("--json")) writeFileAtomically(arguments.text("--json"), writeJson(out));
  return kFine;
}

}  // namespace ps::cli
