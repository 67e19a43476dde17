// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/bench.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/base/statestream.h"
#include "core/experiments/benchscenes.h"
#include "core/experiments/drag.h"
#include "core/experiments/runreport.h"
#include "core/experiments/sketchcost.h"
#include "core/particles/neighbours.h"
#include "core/plugin_host/registry.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <thread>

namespace ps {
namespace {

using nlohmann::json;

constexpr long kWarmUp = 10;

/// s, from some moment on.
double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

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

/// Bytes that the program has asked the heap for and not given back.
double heapBytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

/// Of a stage or a whole frame: its time, what one thread did of it alone, and what it costs by `work`, particles times
/// iterations.
json costOf(const Spread& spread, const Spread& serial, double work) {
  return {{"median", spread.median},
          {"p95", spread.p95},
          {"ns_per_particle_iteration", spread.median * 1e6 / work},
          {"serial_share", spread.median > 0 ? serial.median / spread.median : 0}};
}

double bytesPerParticle(const ParticleStore& store, double pairs) {
  static constexpr size_t kBytes[] = {4, 8, 1, 4, 16};  // by api::FieldType
  size_t fields = 0;
  for (const auto& field : store.fields()) fields += kBytes[static_cast<size_t>(field.type)];
  const double lists = sizeof(uint32_t) * (pairs / static_cast<double>(store.size()) + 3);
  return static_cast<double>(fields) + lists;
}

/// ms, the best of a few: what else the machine does is not the state's cost.
template <class Work>
double bestOf(int runs, Work&& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const double start = now();
    work();
    best = std::min(best, 1000 * (now() - start));
  }
  return best;
}

/// What the state of an engine costs: bytes for each particle, ms to save it and to restore it on one thread, and ms a
/// frame, with its share of one that takes `frameMilliseconds`, for being ready to take a failed frame back.
json measureState(Engine& engine, double frameMilliseconds) {
  StateBuffer whole, lastGood;
  const int threads = threadCount();
  setThreadCount(1);
  const double save = bestOf(5, [&] {
    whole.clear();
    saveTo(whole, engine);
  });
  const double restore = bestOf(3, [&] { engine.restore(StateReader(whole.bytes())); });
  setThreadCount(threads);
  const double ready = bestOf(5, [&] {  // what the solver does at the start of each frame
    lastGood.clear();
    saveTo(lastGood, engine.solver());
  });
  const double particles = static_cast<double>(engine.particles().size());
  return {{"bytes_per_particle", static_cast<double>(whole.bytes().size()) / particles},
          {"save_ms", save},
          {"restore_ms", restore},
          {"rollback_ms", ready},
          {"rollback_share", ready / frameMilliseconds}};
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

}  // namespace

BenchScene benchScene(const std::string& name, const Project& project, PluginRegistry& plugins, long frames) {
  const double heapBefore = heapBytes();
  Engine engine(project, plugins);
  for (long frame = 0; frame < kWarmUp; ++frame) engine.step();
  RunReport report(engine.stats());
  for (long frame = 0; frame < frames; ++frame) {
    const StepReport step = engine.step();
    report.add(step, engine.stats());
  }
  if (report.flags())
    throw Error(name + ": the run set flags: " + flagNames(report.flags()).front() + ": " + report.message());
  const double heap = heapBytes() - heapBefore;
  const ParticleStore& store = engine.particles();
  if (store.size() == 0) throw InputError(name + ": has no particles to measure");
  const ParameterSet& set = project.solver.parameters;
  const double passes = numberOf(set, solverParameters(), "substeps") * numberOf(set, solverParameters(), "iterations");
  const double pairs = countPairs(engine, store), particles = static_cast<double>(store.size());
  const Spread total = report.total(), density = report.stage(static_cast<size_t>(Stage::Density));
  BenchScene measured;
  measured.densityNanosecondsPerPair = density.median * 1e6 / (std::max(pairs, 1.0) * passes);
  json stages;
  for (size_t s = 0; s < static_cast<size_t>(Stage::Count); ++s) {
    stages[stageName(static_cast<Stage>(s))] = costOf(report.stage(s), report.stageSerial(s), particles * passes);
  }
  measured.result = {{"name", name},
                     {"particles", store.size()},
                     {"threads", threadCount()},
                     {"iterations", static_cast<int>(passes)},
                     {"ms", {{"median", total.median}, {"p95", total.p95}}},
                     {"stages", stages},
                     {"ns_per_particle_iteration", total.median * 1e6 / (particles * passes)},
                     {"serial_share", total.median > 0 ? report.totalSerial().median / total.median : 0},
                     {"ns_per_pair", measured.densityNanosecondsPerPair},
                     {"bytes_per_particle", bytesPerParticle(store, pairs)},
                     {"memory_per_particle", heap / particles},
                     {"density_error", report.meanDensityError()},
                     {"state", measureState(engine, total.median)}};
  return measured;
}

json benchDrag(int particles, PluginRegistry& plugins, long frames) {
  const Drag drag = measureDrag(tank(particles), plugins, "water", frames);
  const Spread spread = spreadOf(drag.milliseconds);
  return {{"name", "drag"},
          {"particles", drag.particles},
          {"threads", threadCount()},
          {"ms", {{"median", spread.median}, {"p95", spread.p95}}},
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

json benchSketch(int particles, PluginRegistry& plugins, long frames) {
  const SketchCost cost = measureSketch(tank(particles), plugins, frames);
  json edits, worst;
  double most = -1;
  for (const EditTimes& edit : cost.edits) {
    const Spread spread = spreadOf(edit.milliseconds);
    edits[edit.what] = {{"median", spread.median}, {"p95", spread.p95}, {"limit", edit.limit}};
    if (spread.median / edit.limit <= most) continue;
    most = spread.median / edit.limit;
    worst = {{"median", spread.median}, {"p95", spread.p95}};
  }
  return {
      {"name", "sketch"}, {"particles", cost.particles}, {"threads", threadCount()}, {"ms", worst}, {"edits", edits}};
}

json benchMachine() {
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

json benchCalibration(PluginRegistry& plugins) {
  constexpr int kParticles = 8000;
  const BenchScene density = benchScene("tank", tank(kParticles), plugins, 20);
  return {{"triad_GB_per_s", triad()}, {"density_ns_per_pair", density.densityNanosecondsPerPair}};
}

}  // namespace ps
