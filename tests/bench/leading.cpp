// SPDX-License-Identifier: Apache-2.0
// What a hand costs that leads a tool through a large scene: the command, the contact of the tool while it moves, and
// what measures it for the status line.
//   leading [PARTICLES [FRAMES]]       80000 of water, 60 frames
#include "core/experiments/benchscenes.h"
#include "core/geometry/toolbodies.h"
#include "core/plugin_host/registry.h"
#include "core/scene/pose.h"
#include "core/simulation/engine.h"
#include "core/simulation/toolmeter.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <vector>

using namespace ps;

namespace {

template <class Work>
double millisecondsOf(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Cost {
  std::vector<double> command, contact, frame;
};

/// The tool goes there and back at a speed in m/s; at 0 it stands.
Cost run(Engine& engine, const std::string& tool, double speed, int frames) {
  Cost cost;
  for (int frame = 0; frame < frames; ++frame) {
    const double way = (frame / 10) % 2 == 0 ? speed / 60 : -speed / 60;
    const RigidMove move{Quaternion::Identity(), {way, 0, 0}};
    const auto& bodies = engine.project().bodies;
    const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const Body& one) { return one.id == tool; });
    if (speed > 0) {
      const MoveBody command{std::make_shared<const Body>(moved(*body, move)), move, true};
      cost.command.push_back(millisecondsOf([&] { engine.apply(command); }));
    }
    const StepReport report = engine.step();
    cost.contact.push_back(report.milliseconds[static_cast<size_t>(Stage::Contact)]);
    cost.frame.push_back(report.totalMilliseconds);
  }
  return cost;
}

}  // namespace

int main(int argc, char** argv) {
  const int particles = argc > 1 ? std::atoi(argv[1]) : 80000, frames = argc > 2 ? std::atoi(argv[2]) : 60;
  PluginRegistry plugins;
  Project project = tank(particles);
  const double spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  Body hand = toolBody(ToolForm::Kind::Hand, 12 * spacing, spacing);
  hand.material = project.bodies[0].material;
  hand.parameters.values["temperature"] = 260.0;
  const BodyBounds water = boundsOf(project.bodies[0]);
  project.bodies.insert(project.bodies.begin(), moved(hand, {Quaternion::Identity(), water.middle()}));
  Engine engine(project, plugins);
  std::printf("%zu particles\n", engine.particles().size());
  run(engine, hand.id, 0, 20);
  const Cost stands = run(engine, hand.id, 0, frames);
  for (const double speed : {0.2, 1.0, 10.0}) {
    const Cost moves = run(engine, hand.id, speed, frames);
    std::printf("%4.1f m/s: command %.3f ms, contact %+.3f ms of %.3f, frame %+.2f ms of %.2f\n", speed,
                median(moves.command), median(moves.contact) - median(stands.contact), median(moves.contact),
                median(moves.frame) - median(stands.frame), median(moves.frame));
  }
  ToolMeter meter;
  meter.add(0);
  std::vector<double> measured;
  for (int k = 0; k < 20; ++k) measured.push_back(millisecondsOf([&] { meter.measure(engine.solver(), spacing); }));
  std::printf("measuring it: %.3f ms\n", median(measured));
}
