// SPDX-License-Identifier: Apache-2.0
// What recording costs a run: frames of the tank as the editor makes them, turn by turn with and without.
//   recording [PARTICLES] [FRAMES a turn] [TURNS]
// And what it keeps of a long run, in how much memory:
//   recording PROJECT.json MINUTES MEBIBYTES [SPACING in m]
#include "core/base/memory.h"
#include "core/experiments/benchscenes.h"
#include "core/io/projectio.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/runrecord.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace {
constexpr int kSeeks = 50;
constexpr double kMebibyte = 1 << 20;

/// A line for each tenth of the run.
void runLong(const std::string& path, double minutes, size_t budget, std::optional<double> spacing) {
  ps::PluginRegistry plugins;
  ps::Project project = ps::loadProject(path, plugins).project;
  project.state = nullptr;
  if (spacing) project.solver.parameters.values["particle_spacing"] = *spacing;
  ps::Engine engine(project, plugins);
  const double before = ps::memoryNow().own;
  ps::RunRecord record(budget);
  record.begin(engine.revision());
  record.keepState(engine);
  record.add(engine.snapshot());
  size_t most = 0;
  int tenth = 0;
  while (engine.solver().time() < 60 * minutes) {
    engine.step();
    record.add(engine.snapshot());
    if (record.wantsState(engine.solver().time())) record.keepState(engine);
    record.settle();
    const ps::RunRecord::Cost cost = record.cost();
    most = std::max(most, cost.bytes);
    if (engine.solver().time() < 6 * minutes * (tenth + 1)) continue;
    ++tenth;
    const auto [first, last, from, to, frames] = record.extent();
    std::printf(
        "%6.0f s, %zu particles: %zu of %llu frames and %zu states in %.1f MiB, %.1f at most; the program grew "
        "by %.1f MiB\n",
        to, engine.particles().size(), frames, static_cast<unsigned long long>(last - first + 1), cost.states,
        static_cast<double>(cost.bytes) / kMebibyte, static_cast<double>(most) / kMebibyte,
        (ps::memoryNow().own - before) / kMebibyte);
    std::fflush(stdout);
  }
}
using Clock = std::chrono::steady_clock;
double milliseconds(Clock::time_point from) {
  return std::chrono::duration<double, std::milli>(Clock::now() - from).count();
}

/// Turn by turn with and without; what goes on in the record's thread after a turn is not measured.
void runTurns(ps::Engine& engine, ps::RunRecord& record, int frames, int turns) {
  double sum[2]{}, states = 0;
  int count[2]{}, kept = 0;
  for (int warmUp = 0; warmUp < 5; ++warmUp) engine.step();
  for (int turn = 0; turn < turns; ++turn) {
    const int with = turn % 2;
    for (int frame = 0; frame < frames; ++frame) {
      const auto start = Clock::now();
      engine.step();
      ps::SnapshotPtr snapshot = engine.snapshot();
      if (with) record.add(std::move(snapshot));
      if (with && record.wantsState(engine.solver().time())) {
        record.keepState(engine);
        states += record.cost().stateSeconds * 1000;
        ++kept;
      }
      sum[with] += milliseconds(start);
      ++count[with];
    }
    if (with) record.settle();
  }
  const size_t size = record.extent().frames;
  const auto cost = record.cost();
  std::printf("%zu particles: %.2f ms a frame without, %.2f ms with (%+.1f %%)\n", engine.particles().size(),
              sum[0] / count[0], sum[1] / count[1], 100 * ((sum[1] / count[1]) / (sum[0] / count[0]) - 1));
  std::printf("packed in %.1f ms a frame by a thread of its own; %zu of %d frames kept, %llu left out\n",
              1000 * cost.packSeconds / static_cast<double>(size), size, count[1],
              static_cast<unsigned long long>(cost.leftOut));
  std::printf("%d states in %.1f ms each; %.1f MB in all\n", kept, kept ? states / kept : 0,
              static_cast<double>(cost.bytes) / 1e6);
}

/// Any frame, from memory or from the disk.
void seek(const ps::RunRecord& record, const char* from) {
  const auto extent = record.extent();
  std::mt19937 random(1);
  std::vector<double> took;
  for (int seek = 0; seek < kSeeks; ++seek) {
    const double time = extent.from + (extent.to - extent.from) * static_cast<double>(random()) / 4294967296.0;
    const auto start = Clock::now();
    (void)record.frame(record.frameAt(time).value());
    took.push_back(milliseconds(start));
  }
  std::sort(took.begin(), took.end());
  std::printf("%d frames shown from %s: %.1f ms in the median, %.1f at most\n", kSeeks, from, took[kSeeks / 2],
              took.back());
}
}  // namespace

int main(int argc, char** argv) {
  if (argc > 3 && std::string_view(argv[1]).ends_with(".json")) {
    const auto budget = static_cast<size_t>(std::atof(argv[3]) * kMebibyte);
    runLong(argv[1], std::atof(argv[2]), budget, argc > 4 ? std::optional(std::atof(argv[4])) : std::nullopt);
    return 0;
  }
  const auto number = [&](int at, int usual) { return argc > at ? std::atoi(argv[at]) : usual; };
  ps::PluginRegistry plugins;
  ps::Engine engine(ps::tank(number(1, 100000)), plugins);
  ps::RunRecord record(ps::RunRecord::usualBudget());
  record.begin(engine.revision());
  runTurns(engine, record, number(2, 30), number(3, 6));
  seek(record, "memory");
  record.setBudget({1, size_t{64} << 30, std::filesystem::temp_directory_path().string()});
  record.settle();
  seek(record, "the disk");
}
