// SPDX-License-Identifier: Apache-2.0
#include "core/scene/knowncount.h"
#include "core/scene/project.h"
#include "core/scene/solidform.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr double kSearchedPerParticle = 200;

}  // namespace

double layersAlong(double edge, double spacing) { return std::max(1.0, std::round(edge / spacing)); }

double particleCount(const Body& body, double spacing) {
  double count = 0;
  if (const auto* box = std::get_if<BoxShape>(&body.shape)) {
    count = 1;
    for (const double edge : box->size) count *= layersAlong(edge, spacing);
  } else if (const auto* solid = std::get_if<SolidShape>(&body.shape)) {
    // Its whole box is searched for cells that lie in it: thin matter in a large box counts for some of that.
    const SolidForm form(*solid);
    const double ends = form.kind() == SolidForm::Kind::Rope ? 1 : 0;  // a rope has a particle at both
    if (form.isOneLayer()) return ends + std::max(1.0, std::round(form.volume(spacing) / std::pow(spacing, 3)));
    const double cell = std::pow(spacing, 3), searched = form.size().prod() / kSearchedPerParticle;
    count = std::max(1.0, std::round(std::max(form.volume(), searched) / cell));
  } else {
    const auto& voxels = std::get<VoxelShape>(body.shape);
    for (const VoxelShape::Run& run : voxels.runs) count += run.length;
    count *= std::pow(voxels.spacing / spacing, 3);
  }
  return count;
}

std::optional<double> knownCount(const Body& body, double spacing) {
  if (const auto* solid = std::get_if<SolidShape>(&body.shape)) {
    const SolidForm form(*solid);
    if (form.kind() != SolidForm::Kind::Block || form.isHollow()) return std::nullopt;
    const Vector3 size = form.size();
    return layersAlong(size.x(), spacing) * layersAlong(size.y(), spacing) * layersAlong(size.z(), spacing);
  }
  const auto* sketch = std::get_if<VoxelShape>(&body.shape);
  if (sketch && sketch->spacing != spacing) return std::nullopt;
  return particleCount(body, spacing);
}

double particleCount(const Project& project) {
  const double spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  double count = 0;
  for (const Body& body : project.bodies) count += particleCount(body, spacing);
  return count;
}

}  // namespace ps
