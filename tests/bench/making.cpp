// SPDX-License-Identifier: Apache-2.0
// How long a scene takes to be made, stage by stage, and how long it goes on at most when somebody gives it up.
//
//   making [PARTICLES [CONSTRAINT]]     without them 2000000 particles, bonds; "" for none
#include "core/base/progress.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "tests/shared/scenes.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>
#include <thread>

using namespace ps;

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// s that the present thread has worked: what else the machine does is not the scene's making.
double worked() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class Watch : public Progress {
 public:
  struct Stage {
    double seconds = 0, longest = 0;
    std::string before;  ///< the stage that the longest wait began in
  };
  std::map<std::string, Stage> stages;

 protected:
  void advanced(size_t) override {
    if (std::this_thread::get_id() != m_maker) return;  // who helps it
    const char* name = state().stage;
    Stage& stage = stages[name ? name : "Beginning"];
    const double waited = worked() - m_last;
    stage.seconds += waited;
    if (waited > stage.longest) stage.longest = waited, stage.before = m_name;
    m_last = worked();
    m_name = name ? name : "Beginning";
  }

 private:
  std::thread::id m_maker = std::this_thread::get_id();
  double m_last = worked();
  std::string m_name = "Beginning";
};

}  // namespace

int main(int argc, char** argv) {
  const double particles = argc > 1 ? std::atof(argv[1]) : 2e6;
  const std::string constraint = argc > 2 ? argv[2] : "bonds";
  Project project = scenes::iceOnPlate(static_cast<int>(std::round(std::cbrt(particles))), 300);
  project.bodies[0].constraints.clear();
  if (!constraint.empty()) project.bodies[0].constraints = {{constraint, {}, {}}};
  PluginRegistry plugins;
  Watch watch;
  const auto start = Clock::now();
  const ProgressScope scope(&watch);
  const Engine engine(project, plugins);
  std::printf("%zu particles made in %.2f s\n", engine.particles().size(), secondsSince(start));
  for (const auto& [name, stage] : watch.stages)
    std::printf("%-20s %6.2f s, asked at least every %6.3f s (from %s)\n", name.c_str(), stage.seconds, stage.longest,
                stage.before.c_str());
  const auto asked = Clock::now();
  (void)engine.snapshot();
  std::printf("%-20s %6.2f s\n", "first snapshot", secondsSince(asked));
}
