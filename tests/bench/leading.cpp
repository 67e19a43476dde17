// SPDX-License-Identifier: Apache-2.0
// What a hand costs that leads a tool through a large scene: the command, the contact of the tool while it moves, and
// what measures it for the status line.
//   leading [PARTICLES [FRAMES [COURSE]]]       80000 of water, 60 frames, all courses: "none", "stands", "1 m/s" ...
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
#include <string>
#include <vector>

using namespace ps;

namespace {

template <class Work>
double millisecondsOf(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Of those that were least disturbed by what else the machine does.
double quartile(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// One scene, whose tool goes there and back at a speed in m/s; at 0 it stands.
struct Course {
  const char* what;
  double speed;
  std::unique_ptr<Engine> engine;
  std::vector<double> command{}, contact{}, frame{};

  void step(const std::string& tool, int count) {
    if (speed > 0) {
      const double way = (count / 10) % 2 == 0 ? speed / 60 : -speed / 60;
      const RigidMove move{Quaternion::Identity(), {way, 0, 0}};
      const auto& bodies = engine->project().bodies;
      const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const Body& one) { return one.id == tool; });
      const MoveBody next{std::make_shared<const Body>(moved(*body, move)), move, true};
      command.push_back(millisecondsOf([&] { engine->apply(next); }));
    }
    const StepReport report = engine->step();
    contact.push_back(report.milliseconds[static_cast<size_t>(Stage::Contact)]);
    frame.push_back(report.totalMilliseconds);
  }
};

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 3 ? argv[3] : "";
  const int particles = argc > 1 ? std::atoi(argv[1]) : 80000, frames = argc > 2 ? std::atoi(argv[2]) : 60;
  PluginRegistry plugins;
  Project project = tank(particles);
  const double spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  Body hand = toolBody(ToolForm::Kind::Hand, 12 * spacing, spacing);
  hand.material = project.bodies[0].material;
  hand.parameters.values["temperature"] = 260.0;
  const BodyBounds water = boundsOf(project.bodies[0]);
  project.bodies.insert(project.bodies.begin(), moved(hand, {Quaternion::Identity(), water.middle()}));
  std::vector<Course> courses;
  const auto add = [&](const char* what, double speed) {
    if (only.empty() || only == what) courses.push_back({what, speed, std::make_unique<Engine>(project, plugins)});
  };
  add("stands", 0);
  add("0.2 m/s", 0.2);
  add("1 m/s", 1);
  add("10 m/s", 10);
  project.bodies.erase(project.bodies.begin());
  add("none", 0);
  if (courses.empty()) return 2;
  std::printf("%zu particles\n", courses.front().engine->particles().size());
  for (int frame = 0; frame < frames; ++frame) {
    for (Course& course : courses) course.step(hand.id, frame);  // in turns: the machine is not always as fast
  }
  for (const Course& course : courses) {
    std::printf("%-8s contact %7.3f ms, frame %7.2f ms", course.what, quartile(course.contact), quartile(course.frame));
    if (course.speed > 0) std::printf(", command %.3f ms", quartile(course.command));
    std::printf("\n");
  }
  const Engine& first = *courses.front().engine;
  ToolMeter meter;
  meter.add(0);
  std::vector<double> measured;
  measured.reserve(20);
  for (int k = 0; k < 20; ++k) measured.push_back(millisecondsOf([&] { meter.measure(first.solver(), spacing); }));
  std::printf("measuring it: %.3f ms\n", quartile(measured));
}
