// SPDX-License-Identifier: Apache-2.0
#include "app/cli/benchstate.h"
#include "app/cli/commands.h"
#include "app/cli/run.h"
#include "core/base/error.h"
#include "core/base/jsontext.h"
#include "core/base/parallel.h"
#include "core/experiments/drag.h"
#include "core/experiments/runreport.h"
#include "core/io/textfile.h"
#include "core/particles/neighbours.h"
#include "core/plugin_host/registry.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>

namespace ps::cli {
namespace {

using nlohmann::json;

constexpr OptionSpec kOptions[] = {
    {"--particles", "N", "scales every scene to about so many particles, by its spacing"},
    {"--frames", "N", "frames to measure, after 10 to warm up; without it 240"},
    kThreads,
    kIsa,
    {"--json", "FILE", "writes machine, calibration and scenes"},
};
constexpr long kWarmUp = 10;

/// Water at rest in a tank, twice as wide as high: the density solver's daily work.
Project tank(int particles) {
  constexpr double kSpacing = 0.02;
  const double edge = std::cbrt(particles / 4.0);  // n = 2e x e x 2e
  const double height = std::max(2.0, std::round(edge)) * kSpacing,
               width = std::max(2.0, std::round(2 * edge)) * kSpacing;
  Project project;
  project.title = "tank";
  SceneMaterial water;
  water.id = water.base = "water";
  project.materials.push_back(water);
  Body body;
  body.id = body.name = body.material = "water";
  body.shape = BoxShape{{0, height / 2, 0}, {width, height, width}, {}};
  project.bodies.push_back(body);
  const double half = width / 2;
  project.environment.boundsMinimum = {-half - 1, -1, -half - 1};
  project.environment.boundsMaximum = {half + 1, height + 1, half + 1};
  const Vector3 points[] = {{0, 0, 0}, {-half, 0, 0}, {half, 0, 0}, {0, 0, -half}, {0, 0, half}};
  const Vector3 normals[] = {{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
  for (size_t i = 0; i < 5; ++i) {
    SceneWall wall;
    wall.id = "wall" + std::to_string(i);
    wall.point = points[i];
    wall.normal = normals[i];
    project.environment.walls.push_back(wall);
  }
  project.solver.parameters.values["particle_spacing"] = kSpacing;
  return project;
}

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

/// Changes the spacing so that box bodies hold about this many particles.
void scaleTo(Project& project, long particles, size_t present) {
  if (present == 0) return;
  Value& spacing = project.solver.parameters.values["particle_spacing"];
  spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing") *
            std::cbrt(static_cast<double>(present) / static_cast<double>(particles));
}

/// Ordered pairs within the support, itself left out.
double countPairs(const Engine& engine, const ParticleStore& store) {
  const ParameterSet& set = engine.project().solver.parameters;
  const double support =
      numberOf(set, solverParameters(), "support_ratio") * numberOf(set, solverParameters(), "particle_spacing");
  Neighbours neighbours;
  neighbours.configure(support, 0);
  neighbours.build(store);
  const api::NeighbourView view = neighbours.view();
  double pairs = 0;
  for (size_t i = 0; i < store.size(); ++i) pairs += view.last[i] - view.begin[i];
  return pairs;
}

double bytesPerParticle(const ParticleStore& store, double pairs) {
  static constexpr size_t kBytes[] = {4, 8, 1, 4, 16};  // by api::FieldType
  size_t fields = 0;
  for (const auto& field : store.fields()) fields += kBytes[static_cast<size_t>(field.type)];
  const double lists = sizeof(uint32_t) * (pairs / static_cast<double>(store.size()) + 3);
  return static_cast<double>(fields) + lists;
}

struct Measured {
  json result;
  double densityNanosecondsPerPair = 0;
};

Measured measureScene(const std::string& name, const Project& project, PluginRegistry& plugins, long frames) {
  Engine engine(project, plugins);
  for (long frame = 0; frame < kWarmUp; ++frame) engine.step();
  RunReport report(engine.stats());
  for (long frame = 0; frame < frames; ++frame) {
    const StepReport step = engine.step();
    report.add(step, engine.stats());
  }
  if (report.flags())
    throw Error(name + ": the run set flags: " + flagNames(report.flags()).front() + ": " + report.message());
  const ParticleStore& store = engine.solver().particles();
  if (store.size() == 0) throw InputError(name + ": has no particles to measure");
  const ParameterSet& set = project.solver.parameters;
  const double passes = numberOf(set, solverParameters(), "substeps") * numberOf(set, solverParameters(), "iterations");
  const double pairs = countPairs(engine, store), particles = static_cast<double>(store.size());
  const Spread total = report.total(), density = report.stage(static_cast<size_t>(Stage::Density));
  Measured measured;
  measured.densityNanosecondsPerPair = density.median * 1e6 / (std::max(pairs, 1.0) * passes);
  json stages;
  for (size_t s = 0; s < static_cast<size_t>(Stage::Count); ++s) {
    const Spread spread = report.stage(s);
    stages[stageName(static_cast<Stage>(s))] = {{"median", spread.median}, {"p95", spread.p95}};
  }
  measured.result = {{"name", name},
                     {"particles", store.size()},
                     {"threads", threadCount()},
                     {"iterations", static_cast<int>(passes)},
                     {"ms", {{"median", total.median}, {"p95", total.p95}}},
                     {"stages", stages},
                     {"ns_per_particle_iteration", total.median * 1e6 / (particles * passes)},
                     {"ns_per_pair", measured.densityNanosecondsPerPair},
                     {"bytes_per_particle", bytesPerParticle(store, pairs)},
                     {"density_error", report.meanDensityError()},
                     {"state", measureState(engine, total.median)}};
  return measured;
}

/// McCalpin's triad a = b + s c on arrays far larger than caches: the best of five, in 10^9 bytes per second.
double triad() {
  constexpr size_t kCount = size_t{4} << 20, kGrain = size_t{1} << 16;
  std::vector<double> a(kCount, 0.0), b(kCount, 1.0), c(kCount, 2.0);
  double best = 0;
  for (int run = 0; run < 5; ++run) {
    const double start = now();
    parallelFor(kCount, kGrain, [&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) a[i] = b[i] + 3.0 * c[i];
    });
    best = std::max(best, 3.0 * sizeof(double) * kCount / (now() - start) / 1e9);
  }
  return a[kCount / 2] == 7.0 ? best : 0;
}

json machine() {
  std::string cpu = "unknown", line;
  for (std::ifstream info("/proc/cpuinfo"); std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    cpu = line.substr(line.find(':') + 2);
    break;
  }
  return {{"cpu", cpu},
          {"cores", std::thread::hardware_concurrency()},
          {"isa", instructionSet()},
          {"compiler", __VERSION__}};
}

/// A slider dragged over the tank, which is the same tank left alone in between.
json measureDragged(int particles, PluginRegistry& plugins, long frames) {
  Drag drag = measureDrag(tank(particles), plugins, "water", frames);
  std::sort(drag.milliseconds.begin(), drag.milliseconds.end());
  const auto at = [&](double share) {
    const auto index = static_cast<size_t>(share * static_cast<double>(drag.milliseconds.size()));
    return drag.milliseconds.empty() ? 0 : drag.milliseconds[std::min(index, drag.milliseconds.size() - 1)];
  };
  return {{"name", "drag"},
          {"particles", drag.particles},
          {"threads", threadCount()},
          {"ms", {{"median", at(0.5)}, {"p95", at(0.95)}}},
          {"edits", drag.edits},
          {"edits_per_s", drag.editsPerSecond},
          {"edits_applied", drag.applied},
          {"tables_baked", drag.baked},
          {"frames_per_s_alone", drag.framesAlone},
          {"frames_per_s", drag.framesDragged},
          {"frames_kept", drag.framesDragged / drag.framesAlone},
          {"bake_ms", drag.bakeMilliseconds},
          {"edit_ms", drag.editMilliseconds}};
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
         "file, the name of a sample, 'tank', water at\nrest, or 'drag', the tank while a slider is dragged at 250 "
         "edits a "
         "second, beside the same left alone; without one:\nice-on-hot-plate, tank and drag. iterations are those of a "
         "whole frame; ns_per_pair is the density stage over\nordered pairs within the support.\n\n" +
         optionHelp(kOptions);
}

int benchCommand(CommandArguments given) {
  const Arguments arguments(given, kOptions);
  const auto particles = arguments.integer("--particles", 8, 10'000'000);
  const long frames = arguments.integer("--frames", 1, 1'000'000).value_or(240);
  if (arguments.has("--json")) requireWritable(arguments.text("--json"));
  applyMachineOptions(arguments);
  std::vector<std::string> names = arguments.positional();
  if (names.empty()) names = {"ice-on-hot-plate", "tank", "drag"};
  PluginRegistry plugins;
  constexpr int kCalibrationParticles = 8000;
  const Measured calibration = measureScene("tank", tank(kCalibrationParticles), plugins, 20);
  json out{
      {"machine", machine()},
      {"calibration", {{"triad_GB_per_s", triad()}, {"density_ns_per_pair", calibration.densityNanosecondsPerPair}}},
      {"scenes", json::array()}};
  for (const std::string& name : names) {
    if (name == "drag") {
      out["scenes"].push_back(measureDragged(static_cast<int>(particles.value_or(100000)), plugins, frames / 4));
      printDrag(out["scenes"].back());
      continue;
    }
    Project project;
    if (name == "tank") {
      project = tank(static_cast<int>(particles.value_or(20000)));
    } else {
      const std::string file = sceneFile(name);
      project = loadProject(file, plugins).project;
      if (particles) scaleTo(project, *particles, Engine(project, plugins).solver().particles().size());
    }
    out["scenes"].push_back(measureScene(name, project, plugins, frames).result);
    print(out["scenes"].back());
  }
  if (arguments.has("--json")) writeFileAtomically(arguments.text("--json"), writeJson(out));
  return kFine;
}

}  // namespace ps::cli
