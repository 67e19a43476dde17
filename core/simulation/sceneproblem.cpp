// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/sceneproblem.h"

#include "core/simulation/sceneneed.h"
#include "core/solver/settings.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

const Address kSpacing{Owner::Solver, "", "particle_spacing"}, kReach{Owner::Solver, "", "support_ratio"};

std::string tooMany(double particles) {
  return "the scene would have " + numberText(std::round(particles)) + " particles, more than the " +
         numberText(kMaximumParticles) +
         " that a scene may have; make its bodies smaller or raise the particle spacing";
}

/// Rounded up: what is said to be enough must be.
double fourDigits(double value) {
  const double scale = std::max(1.0, std::pow(10, 3 - std::floor(std::log10(value))));
  return std::ceil(value * scale) / scale;
}

std::string roomProblem(const Project& project, const PluginRegistry* plugins, const SceneScale& scale,
                        const Memory& memory) {
  const double count = needOf(project, plugins, scale).particles;
  return count > kMaximumParticles ? tooMany(count) : memoryProblem(project, plugins, scale, memory);
}

std::string periodProblem(const Project& project, double spacing, double reach) {
  SolverSettings settings;
  settings.spacing = spacing;
  settings.supportRatio = reach;
  const double least = leastPeriod(settings);
  const Environment& environment = project.environment;
  for (size_t a = 0; a < 3; ++a) {
    const double edge = environment.boundsMaximum[a] - environment.boundsMinimum[a];
    if (!environment.periodic[a] || edge >= least) continue;
    return std::string("the scene repeats itself along ") + "xyz"[a] + " every " + numberText(edge) +
           " m; with this reach of its particles that must be " + numberText(fourDigits(least)) +
           " m or more; lower the particle spacing";
  }
  return {};
}

/// Of a box, whose coldest particle stands in a corner of its lattice.
std::string gradientProblem(const Body& body, double temperature, double spacing) {
  const Vector3& gradient = body.temperatureGradient;
  const auto* box = std::get_if<BoxShape>(&body.shape);
  if (!box) return {};
  double coldest = temperature;
  for (size_t a = 0; a < 3; ++a)
    coldest -= std::abs(gradient[a]) * (layersAlong(box->size[a], spacing) - 1) * spacing / 2;
  if (coldest >= 1) return {};
  return "its temperature gradient would cool it to " + numberText(coldest) +
         " K; a higher temperature or a lower gradient is needed";
}

double solverNumber(const Project& project, const Address& address) {
  return numberOf(project.solver.parameters, solverParameters(), address.key);
}

}  // namespace

std::string problemOfSceneWith(const Project& project, const PluginRegistry* plugins, const Address& address,
                               const Value& value) {
  const auto* number = std::get_if<double>(&value);
  if (!number) return {};
  if (address == kSpacing || address == kReach) {
    SceneScale scale = scaleOf(project);
    (address == kSpacing ? scale.spacing : scale.reach) = *number;
    const std::string problem = roomProblem(project, plugins, scale, memoryNow());
    return problem.empty() ? periodProblem(project, scale.spacing, scale.reach) : problem;
  }
  if (address.owner != Owner::Body || address.key != "temperature") return {};
  const auto body =
      std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& b) { return b.id == address.id; });
  return body == project.bodies.end() ? std::string()
                                      : gradientProblem(*body, *number, solverNumber(project, kSpacing));
}

void requireFewer(double particles) {
  if (particles > kMaximumParticles) throw SceneError(tooMany(particles), kSpacing);
}

void requireRoom(const Project& project, const PluginRegistry& plugins, const Memory& memory) {
  const std::string problem = roomProblem(project, &plugins, scaleOf(project), memory);
  if (!problem.empty()) throw SceneError(problem, kSpacing);
}

void requireRoomFor(double living, double more, double bytesEach, const Memory& memory) {
  requireFewer(living + more);
  if (more * bytesEach <= roomToGrow(memory)) return;
  throw SceneError("this takes about " + memoryText(more * bytesEach) + " of memory for " + particlesText(more) +
                       ", and this machine has " + memoryText(std::max(0.0, roomToGrow(memory))) +
                       " for it; make it smaller or raise the particle spacing",
                   kSpacing);
}

void requirePeriods(const Project& project) {
  const double spacing = solverNumber(project, kSpacing), reach = solverNumber(project, kReach);
  const std::string problem = periodProblem(project, spacing, reach);
  if (!problem.empty()) throw SceneError(problem, kSpacing);
}

}  // namespace ps
