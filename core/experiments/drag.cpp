// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/drag.h"

#include "core/base/error.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/compile.h"
#include "core/simulation/enginethread.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace ps {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kBetweenEdits = std::chrono::milliseconds(4);
constexpr int kTurns = 4;  ///< of each kind: what else the machine does falls on both
constexpr long kLeastFrames = 3;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

uint64_t frameOf(const EngineThread& thread) {
  const SnapshotPtr snapshot = thread.snapshot();
  return snapshot ? snapshot->stats.frame : 0;
}

/// s, the median of five.
double bakeSeconds(const Project& project, const PluginRegistry& plugins, const std::string& id) {
  const std::vector<Material> materials = compileMaterials(project, plugins);
  const auto material = std::find_if(materials.begin(), materials.end(), [&](const Material& m) { return m.id == id; });
  if (material == materials.end()) throw InputError("the scene has no material '" + id + "' to drag");
  std::vector<double> seconds;
  for (int run = 0; run < 5; ++run) {
    const auto start = Clock::now();
    const BakedMaterial table(*material, compileThermal(project).ambientPressure);
    seconds.push_back(secondsSince(start));
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[2];
}

/// Frames per second from one frame's end to another's, `frames` later; `each` is called every 4 ms meanwhile.
template <class Each>
double framesPerSecond(const EngineThread& thread, long frames, Each each) {
  const auto waitFor = [&](uint64_t frame) {
    auto next = Clock::now();
    while (frameOf(thread) < frame && thread.playing()) {
      each();
      next += kBetweenEdits;
      std::this_thread::sleep_until(next);
    }
  };
  waitFor(frameOf(thread) + 1);
  const uint64_t first = frameOf(thread);
  const auto start = Clock::now();
  waitFor(first + static_cast<uint64_t>(frames));
  return static_cast<double>(frameOf(thread) - first) / secondsSince(start);
}

}  // namespace

Drag measureDrag(const Project& project, PluginRegistry& plugins, const std::string& material, long frames) {
  Drag drag;
  drag.bakeMilliseconds = 1e3 * bakeSeconds(project, plugins, material);
  Project endless = project;
  endless.duration = 1e9;
  EngineThread thread(plugins, {});
  thread.open(endless, true);
  while (!thread.snapshot() && thread.events(0).empty()) std::this_thread::sleep_for(kBetweenEdits);
  if (!thread.events(0).empty()) throw InputError(thread.events(0).front().message);
  const Address viscosity{Owner::Material, material, "viscosity"};
  const long turn = std::max(kLeastFrames, frames / kTurns);
  framesPerSecond(thread, 2, [] {});  // warms up
  double dragging = 0;
  for (int k = 0; k < kTurns; ++k) {
    drag.framesAlone += framesPerSecond(thread, turn, [] {}) / kTurns;
    const uint64_t before = thread.snapshot()->stats.frame + 1;
    const auto begin = Clock::now();
    drag.framesDragged += framesPerSecond(thread, turn,
                                          [&] {
                                            const double share = static_cast<double>(drag.edits % 250) / 250;
                                            thread.setParameter(viscosity, Response(1e-3 * (1 + 0.1 * share)));
                                            ++drag.edits;
                                          }) /
                          kTurns;
    dragging += secondsSince(begin);
    for (const FrameStats& stats : thread.history(before)) drag.milliseconds.push_back(stats.totalMilliseconds);
  }
  thread.pause();
  const EditCost cost = thread.editCost();
  drag.particles = thread.snapshot()->id.size();
  drag.editsPerSecond = static_cast<double>(drag.edits) / std::max(dragging, 1e-9);
  drag.applied = cost.applied;
  drag.baked = cost.baked;
  drag.editMilliseconds = 1e3 * cost.seconds / static_cast<double>(std::max<uint64_t>(cost.applied, 1));
  return drag;
}

}  // namespace ps
