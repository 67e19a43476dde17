// SPDX-License-Identifier: Apache-2.0
// From a project to frames: a scene that opens runs, on one thread, and what becomes of it is physical or flagged.
#include "core/simulation/engine.h"
#include "core/base/log.h"
#include "core/base/parallel.h"
#include "tests/fuzz/fuzz.h"

#include <cmath>

namespace {

using namespace ps;

constexpr double kMostParticles = 2000;
constexpr int kFrames = 2;

/// Scenes that would take seconds say nothing more than small ones.
bool isSmall(const Project& project) {
  const auto solver = [&](const char* key) { return numberOf(project.solver.parameters, solverParameters(), key); };
  const double particles = std::max(particleCount(project), 50.0);
  return particles <= kMostParticles && particles * solver("substeps") * solver("iterations") < 2e4;
}

void requirePhysical(const Engine& engine) {
  const SnapshotPtr now = engine.snapshot();
  for (size_t i = 0; i < now->position.size(); ++i) {
    const api::Float4& p = now->position[i];
    fuzz::require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(now->speed[i]),
                  "a particle that is not finite is flagged");
    fuzz::require(now->temperature[i] >= 0 && std::isfinite(now->temperature[i]), "no matter is colder than 0 K");
    fuzz::require(now->gasFraction[i] >= 0 && now->gasFraction[i] <= 1, "shares lie between 0 and 1");
  }
}

void run(const Project& project) {
  Engine engine(project, fuzz::plugins());
  requirePhysical(engine);
  for (int frame = 0; frame < kFrames; ++frame) {
    const StepReport report = engine.step();
    fuzz::require(report.faults.empty(), "no plugin of ours fails: " + report.message);
    requirePhysical(engine);
    if (report.flags & kTakenBack) return;
  }
  fuzz::require(engine.lateFaults().empty(), "no plugin of ours fails");
}

}  // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const bool once = [] {
    setThreadCount(1);
    setLogHook([](LogLevel, std::string_view) {});  // what scenes leave out is told for each of them
    return true;
  }();
  (void)once;
  try {
    const Project project = parseProject(fuzz::textOf(data, size), fuzz::kName, fuzz::plugins()).project;
    if (isSmall(project)) run(project);
  } catch (const InputError&) {
    // Which sentence it is refused with is the affair of the target `project`.
  }
  return 0;
}
