// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/sceneproblem.h"

#include "core/geometry/solidfill.h"
#include "core/scene/shownname.h"
#include "core/simulation/lattice.h"
#include "core/simulation/sceneneed.h"
#include "core/solver/settings.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// K at the coldest place of matter of `temperature` at `centre`; where nothing stands: `temperature`.
double coldestOf(const std::vector<api::Double3>& places, double temperature, const Vector3& centre,
                 const Vector3& gradient) {
  double coldest = temperature;
  for (const api::Double3& p : places)
    coldest = std::min(coldest, temperature + gradient.dot(Vector3(p.x, p.y, p.z) - centre));
  return coldest;
}

/// Of a box the coldest particle stands in a corner of its lattice.
double coldestOf(const BoxShape& box, double temperature, const Vector3& gradient, double spacing) {
  for (size_t a = 0; a < 3; ++a)
    temperature -= std::abs(gradient[a]) * (layersAlong(box.size[a], spacing) - 1) * spacing / 2;
  return temperature;
}

double coldestOf(const VoxelShape& voxels, const Vector3& gradient, double spacing) {
  std::vector<std::vector<api::Double3>> places;
  Vector3 sum;
  double count = 0, coldest = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < voxels.palette.size(); ++k) {
    places.push_back(cellCentres(voxels, spacing, cellsOf(voxels, static_cast<int>(k))));
    for (const api::Double3& p : places.back()) sum += Vector3(p.x, p.y, p.z);
    count += static_cast<double>(places.back().size());
  }
  const Vector3 centre = sum / std::max(count, 1.0);
  for (size_t k = 0; k < places.size(); ++k)
    coldest = std::min(coldest, coldestOf(places[k], voxels.palette[k].temperature, centre, gradient));
  return coldest;
}

double coldestOf(const Body& body, double temperature, const Vector3& gradient, double spacing) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) return coldestOf(*box, temperature, gradient, spacing);
  const auto* solid = std::get_if<SolidShape>(&body.shape);
  if (!solid) return coldestOf(std::get<VoxelShape>(body.shape), gradient, spacing);
  const std::vector<api::Double3> places = latticePlaces(*solid, spacing);
  Vector3 sum;
  for (const api::Double3& p : places) sum += vectorOf(p);
  return coldestOf(places, temperature, sum / static_cast<double>(places.size()), gradient);
}

std::string coldProblemOfAny(const Project& project, double spacing) {
  for (const Body& body : project.bodies) {
    const double temperature = numberOf(body.parameters, bodyParameters(), "temperature");
    const std::string problem = coldProblem(body, temperature, spacing);
    if (!problem.empty()) return "of '" + shownName(body) + "' " + problem;
  }
  return {};
}

std::string firstPeriodProblem(const Project& project, double spacing, double reach) {
  const auto problems = periodProblems(project, spacing, reach);
  return problems.empty() ? std::string() : problems.front().second + "; lower the particle spacing";
}

double solverNumber(const Project& project, const Address& address) {
  return numberOf(project.solver.parameters, solverParameters(), address.key);
}

}  // namespace

std::string coldProblem(const Body& body, double temperature, double spacing) {
  const Vector3& gradient = body.temperatureGradient;
  if (gradient == Vector3::Zero()) return {};
  const double coldest = coldestOf(body, temperature, gradient, spacing);
  if (coldest >= 1) return {};
  return "its temperature gradient would cool it to " + numberText(coldest) +
         " K; a higher temperature or a lower gradient is needed";
}

std::vector<std::pair<size_t, std::string>> periodProblems(const Project& project, double spacing, double reach) {
  SolverSettings settings;
  settings.spacing = spacing;
  settings.supportRatio = reach;
  const double least = leastPeriod(settings);
  const Environment& environment = project.environment;
  std::vector<std::pair<size_t, std::string>> problems;
  for (size_t a = 0; a < 3; ++a) {
    const double edge = environment.boundsMaximum[a] - environment.boundsMinimum[a];
    if (!environment.periodic[a] || edge >= least) continue;
    problems.emplace_back(a, std::string("the scene repeats itself along ") + "xyz"[a] + " every " + numberText(edge) +
                                 " m; with this reach of its particles that must be " + numberText(fourDigits(least)) +
                                 " m or more");
  }
  return problems;
}

std::string problemOfSceneWith(const Project& project, const PluginRegistry* plugins, const Address& address,
                               const Value& value) {
  if (address.owner == Owner::Shape && value == Value(std::string("mesh"))) {
    const auto body =
        std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& b) { return b.id == address.id; });
    const auto* solid = body == project.bodies.end() ? nullptr : std::get_if<SolidShape>(&body->shape);
    return solid && solid->mesh ? std::string() : "it has no mesh; Add, Import mesh… brings a body of one";
  }
  const auto* number = std::get_if<double>(&value);
  if (!number) return {};
  if (address == kSpacing || address == kReach) {
    SceneScale scale = scaleOf(project);
    (address == kSpacing ? scale.spacing : scale.reach) = *number;
    std::string problem = roomProblem(project, plugins, scale, memoryNow());
    if (problem.empty()) problem = firstPeriodProblem(project, scale.spacing, scale.reach);
    return problem.empty() ? coldProblemOfAny(project, scale.spacing) : problem;
  }
  if (address.owner != Owner::Body || address.key != "temperature") return {};
  const auto body =
      std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& b) { return b.id == address.id; });
  return body == project.bodies.end() ? std::string() : coldProblem(*body, *number, solverNumber(project, kSpacing));
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
  const std::string problem = firstPeriodProblem(project, spacing, reach);
  if (!problem.empty()) throw SceneError(problem, kSpacing);
}

}  // namespace ps
