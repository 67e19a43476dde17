// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/run.h"

namespace ps {

double frameLength(const Project& project) { return numberOf(project.solver.parameters, solverParameters(), "dt"); }

bool runFrames(Engine& engine, long frames, const FrameVisitor& each, const StopTest& stop) {
  for (long frame = 1; frame <= frames; ++frame) {
    const StepReport step = engine.step();
    each(step, engine.stats());
    if (step.flags & kTakenBack) return false;
    if (stop && stop()) return false;
  }
  return true;
}

}  // namespace ps
