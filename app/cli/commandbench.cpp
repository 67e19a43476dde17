// SPDX-License-Identifier: Apache-2.0
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/base/parallel.h"
#include "core/experiments/bench.h"
#include "core/experiments/benchscenes.h"
#include "core/experiments/benchtables.h"
#include "core/io/outputfile.h"
#include "core/io/textfile.h"
#include "core/plugin_host/registry.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <vector>

namespace ps::cli {
namespace {

using nlohmann::json;

constexpr OptionSpec kOptions[] = {
    {"--particles", "N", "scales every scene to about so many particles, by its spacing"},
    {"--frames", "N", "frames to measure, after 10 to warm up; without it 240"},
    {kThreads.name, "N[,N...]", "number of threads, or several, each in its turn; without it one per core"},
    kIsa,
    kPatience,
    {"--growth", "", "each scene with 5,000 to 500,000 particles"},
    {"--table", "FILE", "writes the rows as CSV"},
    {"--plot", "FILE", "draws ms per frame over particles as SVG"},
    {"--compare", "FILE", "shows the rows beside those of an earlier --json, new by old"},
    {"--json", "FILE", "writes machine, calibration and scenes"},
};

/// Particles of each scene for --growth.
constexpr long kGrowth[] = {5000, 10'000, 20'000, 50'000, 100'000, 200'000, 500'000};
constexpr size_t kMostBytes = size_t{64} << 20;  // of an earlier file

/// Where projects are: installed beside the program, or, of one that was built in its tree, beside the sources. Never
/// the other way round: a folder that happens to be called as the sources were is somebody else's.
std::vector<std::filesystem::path> projectFolders() {
  std::error_code problem;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", problem).parent_path();
  return {program / "../share/phasesketch/projects", PS_SOURCE_PROJECTS};
}

/// "'tank', 'dambreak-20k', ...": those that are made, and those that are files.
std::string namedScenes() {
  std::vector<std::string> names = benchSceneNames(), files;
  for (const std::filesystem::path& folder : projectFolders()) {
    std::error_code problem;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "bench", problem))
      files.push_back(entry.path().stem().string());
    if (!files.empty()) break;
  }
  std::sort(files.begin(), files.end());
  names.insert(names.end(), files.begin(), files.end());
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

/// Numbers of threads to measure with; 0: one per core.
std::vector<int> threadsOf(const Arguments& arguments) {
  constexpr int kMost = 1024;
  if (!arguments.has(kThreads.name)) return {0};
  const std::string text = arguments.text(kThreads.name);
  std::vector<int> threads;
  for (size_t from = 0; from <= text.size();) {
    const size_t end = std::min(text.find(',', from), text.size());
    int count = 0;
    const auto [stop, problem] = std::from_chars(text.data() + from, text.data() + end, count);
    if (problem != std::errc() || stop != text.data() + end || count < 1 || count > kMost) {
      throw InputError(std::string(kThreads.name) + " must be whole numbers from 1 to " + std::to_string(kMost) +
                       ", with commas between them, not '" + text + "'");
    }
    threads.push_back(count);
    from = end + 1;
  }
  return threads;
}

/// A file, or the name of a sample project, of one of the thesis's or of one that is there to be measured.
std::string sceneFile(const std::string& name) {
  if (std::filesystem::exists(name)) return name;
  std::error_code problem;
  for (const std::filesystem::path& folder : projectFolders()) {
    for (const char* kind : {"", "thesis", "bench"}) {
      const std::filesystem::path file = folder / kind / (name + ".json");
      if (std::filesystem::exists(file, problem)) return file.string();
    }
  }
  throw InputError(name + ": neither a file nor a sample project nor one of " + namedScenes());
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

void printSketch(const json& row) {
  std::printf("%-20s %8zu particles  %2d threads  ms of the engine's thread:\n", "sketch",
              row["particles"].get<size_t>(), row["threads"].get<int>());
  for (const auto& [what, cost] : row["edits"].items())
    std::printf("  %-18s %7.3f ms a sample (p95 %.3f), at most %g\n", what.c_str(), cost["median"].get<double>(),
                cost["p95"].get<double>(), cost["limit"].get<double>());
  std::fflush(stdout);
}

void print(const json& scene) {
  const double milliseconds = scene["ms"]["median"];
  std::printf(
      "%-20s %8zu particles  %2d threads  %7.2f ms per frame (p95 %.2f)  %6.1f frames/s  %.2f ns per pair  "
      "%.1f %% on one thread\n",
      scene["name"].get<std::string>().c_str(), scene["particles"].get<size_t>(), scene["threads"].get<int>(),
      milliseconds, scene["ms"]["p95"].get<double>(), milliseconds > 0 ? 1000 / milliseconds : 0,
      scene["ns_per_pair"].get<double>(), 100 * scene["serial_share"].get<double>());
  for (const auto& [stage, cost] : scene["stages"].items()) {
    if (cost["median"].get<double>() < 0.01 * milliseconds) continue;
    std::printf("  %-18s %7.2f ms (p95 %.2f)  %7.2f ns per particle and iteration  %5.1f %% on one thread\n",
                stage.c_str(), cost["median"].get<double>(), cost["p95"].get<double>(),
                cost["ns_per_particle_iteration"].get<double>(), 100 * cost["serial_share"].get<double>());
  }
  const json& state = scene["state"];
  std::printf(
      "%-20s %8.0f bytes per particle, saved in %.1f ms, restored in %.1f ms, ready to roll back in %.2f ms, "
      "%.1f %% of a frame; %.0f bytes per particle in all\n",
      "  state", state["bytes_per_particle"].get<double>(), state["save_ms"].get<double>(),
      state["restore_ms"].get<double>(), state["rollback_ms"].get<double>(),
      100 * state["rollback_share"].get<double>(), scene["memory_per_particle"].get<double>());
  std::fflush(stdout);
}

void printCompared(const json& rows) {
  for (const json& row : rows) {
    std::printf("%-20s %8zu particles  %2d threads  %.3f of before:", row["name"].get<std::string>().c_str(),
                row["particles"].get<size_t>(), row["threads"].get<int>(), row["ratio"].get<double>());
    for (const auto& [stage, ratio] : row["stages"].items())
      std::printf("  %s %.3f", stage.c_str(), ratio.get<double>());
    std::printf("\n");
  }
}

Project projectOf(const std::string& name, std::optional<long> particles, PluginRegistry& plugins) {
  if (std::optional<Project> built = benchProject(name, particles)) return *std::move(built);
  Project project = loadProject(sceneFile(name), plugins).project;
  project.state = nullptr;  // figures of a scene are compared with those of another day
  if (particles) scaleTo(project, *particles, Engine(project, plugins).particles().size());
  return project;
}

/// Measures a scene with each number of threads.
void measure(const std::string& name, std::optional<long> particles, const std::vector<int>& threads, long frames,
             PluginRegistry& plugins, json& rows) {
  for (const int count : threads) {
    setThreadCount(count);
    if (name == "drag") {
      rows.push_back(benchDrag(static_cast<int>(particles.value_or(100000)), plugins, frames / 4));
      printDrag(rows.back());
    } else if (name == "sketch") {
      rows.push_back(benchSketch(static_cast<int>(particles.value_or(80000)), plugins, std::max(1L, frames / 4)));
      printSketch(rows.back());
    } else {
      rows.push_back(benchScene(name, projectOf(name, particles, plugins), plugins, frames).result);
      print(rows.back());
    }
  }
}

void writeTables(const Arguments& arguments, const json& rows) {
  json scenes = json::array();
  for (const json& row : rows) {
    if (row.contains("stages")) scenes.push_back(row);
  }
  if (arguments.has("--table")) writeFileAtomically(arguments.text("--table"), growthTable(scenes));
  if (arguments.has("--plot")) writeFileAtomically(arguments.text("--plot"), growthPlot(scenes));
}

}  // namespace

std::string benchHelp() {
  return "phasesketch-cli bench [SCENE...] [options]\n\nMeasures the path that simulate runs. A scene is a project "
         "file, which begins at its start, the name of a sample or\nof one of the thesis's scenes, 'drag', the "
         "tank while a slider is dragged at 250 edits a second, beside the same\nleft alone, 'sketch', what strokes "
         "and hands cost the engine's thread in it for each sample, or one of\n" +
         namedScenes() +
         ";\nwithout one: ice-on-hot-plate, tank and drag. iterations are those of a whole frame; ns_per_pair is the "
         "density stage\nover ordered pairs within the support; serial_share is what one thread does alone of a frame "
         "or a stage, outside of\nloops that threads share; memory_per_particle is what the engine has taken.\n\n" +
         optionHelp(kOptions);
}

int benchCommand(CommandArguments list) {
  const Arguments arguments(list, kOptions);
  const auto particles = arguments.integer("--particles", 8, 10'000'000);
  const long frames = arguments.integer("--frames", 1, 1'000'000).value_or(240);
  if (particles && arguments.has("--growth")) throw InputError("give --particles or --growth, not both");
  const std::vector<int> threads = threadsOf(arguments);
  std::vector<std::string> read = arguments.positional();
  json old;
  if (arguments.has("--compare")) {
    const std::string file = arguments.text("--compare");
    read.push_back(file);
    old = parseJson(readFile(file, kMostBytes), file);
    if (!old.contains("scenes")) throw InputError(file + ": is no file that bench wrote");
  }
  requireOutputs(arguments, read, {"--table", "--plot", "--json"});
  if (arguments.has(kIsa.name)) setInstructionSet(arguments.text(kIsa.name));
  watchPlugins(arguments);
  setThreadCount(threads.front());
  std::vector<std::string> names = arguments.positional();
  if (names.empty()) names = {"ice-on-hot-plate", "tank", "drag"};
  PluginRegistry plugins;
  json out{{"machine", benchMachine()}, {"calibration", benchCalibration(plugins)}, {"scenes", json::array()}};
  for (const std::string& name : names) {
    if (!arguments.has("--growth")) {
      measure(name, particles, threads, frames, plugins, out["scenes"]);
      continue;
    }
    for (const long count : kGrowth) measure(name, count, threads, frames, plugins, out["scenes"]);
  }
  if (!old.is_null()) {
    const std::string other = machineDifference(old, out);
    if (!other.empty()) std::printf("not the same machine: %s\n", other.c_str());
    out["compared"] = compareBench(old, out, arguments.text("--compare"));
    printCompared(out["compared"]);
  }
  writeTables(arguments, out["scenes"]);
  if (arguments.has("--json")) writeFileAtomically(arguments.text("--json"), writeJson(out));
  return kFine;
}

}  // namespace ps::cli
