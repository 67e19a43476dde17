// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/finersteps.h"

#include "core/scene/track.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ps {
namespace {

/// Above, substeps are no more than doubled: what they cost is felt.
constexpr int kMany = 16;
constexpr double kRounding = 1e-6;

double solverNumber(const Project& project, const char* key) {
  return numberOf(project.solver.parameters, solverParameters(), key);
}

bool hasTrack(const Project& project, const char* key) {
  return findTrack(project.tracks, std::string("solver/") + key) != nullptr;
}

int mostSubsteps() { return static_cast<int>(findDeclaration(solverParameters(), "substeps")->hardMaximum); }

}  // namespace

std::optional<FinerSteps> finerSteps(const Project& project) {
  const auto substeps = static_cast<int>(solverNumber(project, "substeps"));
  const auto iterations = static_cast<int>(solverNumber(project, "iterations"));
  const auto least = static_cast<int>(solverNumber({}, "iterations"));
  if (substeps >= mostSubsteps() || hasTrack(project, "substeps") || hasTrack(project, "iterations"))
    return std::nullopt;
  const int finer = std::max(2 * substeps, std::min(4 * substeps, kMany));
  return FinerSteps{std::min(finer, mostSubsteps()), std::max(iterations, least)};
}

std::optional<int> substepsAtSpacing(const Project& project) {
  for (const char* key : {"substeps", "iterations", "dt"}) {
    if (project.solver.parameters.values.contains(key) || hasTrack(project, key)) return std::nullopt;
  }
  const Project plain;
  const double finer = solverNumber(plain, "particle_spacing") / solverNumber(project, "particle_spacing");
  const double heavier = project.environment.gravity.norm() / plain.environment.gravity.norm();
  const double usual = solverNumber(plain, "substeps"),
               wanted = std::ceil(usual * std::sqrt(finer * heavier) - kRounding);
  if (!(wanted >= 2 * usual)) return std::nullopt;
  return std::min(static_cast<int>(wanted), mostSubsteps());
}

}  // namespace ps
