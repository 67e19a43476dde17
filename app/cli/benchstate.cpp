// SPDX-License-Identifier: Apache-2.0
#include "app/cli/benchstate.h"

#include "app/cli/run.h"
#include "core/base/parallel.h"
#include "core/base/statestream.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace ps::cli {
namespace {

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

}  // namespace

nlohmann::json measureState(Engine& engine, double frameMilliseconds) {
  StateBuffer whole, lastGood;
  const int threads = threadCount();
  setThreadCount(1);
  const double save = bestOf(5, [&] {
    whole.clear();
    StateWriter writer(whole);
    engine.save(writer);
    writer.finish();
  });
  const double restore = bestOf(3, [&] { engine.restore(StateReader(whole.bytes())); });
  setThreadCount(threads);
  const double ready = bestOf(5, [&] {  // what the solver does at the start of each frame
    lastGood.clear();
    StateWriter writer(lastGood);
    engine.solver().save(writer);
    writer.finish();
  });
  const double particles = static_cast<double>(engine.solver().particles().size());
  return {{"bytes_per_particle", static_cast<double>(whole.bytes().size()) / particles},
          {"save_ms", save},
          {"restore_ms", restore},
          {"rollback_ms", ready},
          {"rollback_share", ready / frameMilliseconds}};
}

}  // namespace ps::cli
