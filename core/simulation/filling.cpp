// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/filling.h"

#include "core/geometry/solidfill.h"
#include "core/scene/shownname.h"
#include "core/scene/solidform.h"
#include "core/simulation/lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <variant>

namespace ps {
namespace {

constexpr double kTold = 0.05;  ///< of a body's volume
/// Particles of a solid from which on its lattice misses less of its volume than is told.
constexpr double kSurelyFilled = 5000;
constexpr double kFinest = 0.5;  ///< of the present spacing, down to which another one is sought

/// Share of a body's volume by which particles miss it; negative where they leave some of it out.
double missedOf(const Body& body, double spacing) {
  const Filling filling = fillingOf(body, spacing);
  return filling.asked > 0 ? filling.filled / filling.asked - 1 : 0;
}

bool isTold(double missed) { return std::abs(missed) > kTold; }

/// Edges whose layers may be whole ones: of a box, or of a sketched cell.
Vector3 edgesOf(const Body& body) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) return box->size;
  return Vector3::Constant(std::get<VoxelShape>(body.shape).spacing);
}

/// The coarsest spacing below the present one at which no body's volume is missed by what is told; 0: none that is not
/// much finer.
double fittingSpacing(const Project& project, const Body& body, double spacing) {
  double best = 0;
  if (std::holds_alternative<SolidShape>(body.shape)) return 0;  // of round ones no spacing is better than others
  const auto fits = [&](double one) {
    return std::none_of(project.bodies.begin(), project.bodies.end(), [&](const Body& other) {
      return !std::holds_alternative<SolidShape>(other.shape) && isTold(missedOf(other, one));
    });
  };
  for (const double edge : edgesOf(body)) {
    // What is thinner than the finest has no whole layers.
    for (double layers = std::ceil(edge / spacing); layers <= edge / (kFinest * spacing); ++layers) {
      const double one = edge / layers;
      if (one < spacing && one > best && fits(one)) best = one;
    }
  }
  return best;
}

}  // namespace

Filling fillingOf(const Body& body, double spacing) {
  const double cell = spacing * spacing * spacing;
  if (const auto* box = std::get_if<BoxShape>(&body.shape))
    return {box->size[0] * box->size[1] * box->size[2], particleCount(body, spacing) * cell};
  if (const auto* solid = std::get_if<SolidShape>(&body.shape)) {
    const SolidForm form(*solid);
    const double asked = form.volume(spacing);
    if (form.isOneLayer()) return {asked, asked};
    if (asked > kSurelyFilled * cell) return {asked, asked};
    const SolidCells filled = fillSolid(*solid, spacing);
    return {asked, static_cast<double>(filled.cells.size()) * filled.stretch.prod() * cell};
  }
  const auto& voxels = std::get<VoxelShape>(body.shape);
  double cells = 0;
  for (const VoxelShape::Run& run : voxels.runs) cells += run.length;
  return {cells * voxels.spacing * voxels.spacing * voxels.spacing, resampledCount(voxels, spacing) * cell};
}

std::optional<Limit> fillLimit(const Project& project, double spacing) {
  const Body* worst = nullptr;
  double most = 0;
  for (const Body& body : project.bodies) {
    const double missed = missedOf(body, spacing);
    if (!isTold(missed) || std::abs(missed) <= std::abs(most)) continue;
    worst = &body, most = missed;
  }
  if (!worst) return std::nullopt;
  const Filling filling = fillingOf(*worst, spacing);
  Limit limit{kFillLimit, filling.asked, filling.filled, "m³"};
  char share[32];
  std::snprintf(share, sizeof share, "%.0f %% %s", 100 * std::abs(most), most > 0 ? "more" : "less");
  limit.why = "whole layers of particles make '" + shownName(*worst) + "' " + share + " than its shape";
  if (const double fitting = fittingSpacing(project, *worst, spacing); fitting > 0)
    limit.use = useOf("solver/particle_spacing", fitting);
  return limit;
}

}  // namespace ps
