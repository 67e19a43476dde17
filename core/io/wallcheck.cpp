// SPDX-License-Identifier: Apache-2.0
#include "core/io/wallcheck.h"

#include "core/parameters/wording.h"
#include "core/scene/scenewall.h"

#include <cmath>

namespace ps {
namespace {

/// Share of a wall's normal along a periodic axis that rounding explains.
constexpr double kLeaning = 1e-6;
/// Spacings: liquids meet what is behind a curved wall to first order in its curvature, which is less than half of what
/// a kernel reaches from here on.
constexpr double kLeastRadius = 4;

void checkPeriod(const SceneWall& wall, int axis, std::vector<WallFinding>& out) {
  const WallFace face = faceOf(wall);
  const std::string name(1, "xyz"[axis]), why = "the scene is periodic along " + name;
  const double along = std::abs(wall.normal[axis]), whole = wall.normal.norm();
  const double across = std::sqrt(std::max(0.0, whole * whole - along * along));
  if (face.form() == WallForm::Plane && along > kLeaning * whole) {
    out.push_back({true, "/normal/" + std::to_string(axis),
                   "must be 0: " + why +
                       ", and a wall that leans along it would not meet its own image; let gravity lean instead"});
  } else if (face.form() == WallForm::Cylinder && across > kLeaning * whole) {
    out.push_back({true, "/normal",
                   "must point along " + name + ": " + why + ", and another cylinder would not meet its own image"});
  } else if (face.form() == WallForm::Sphere) {
    out.push_back(
        {true, "/shape", "cannot be sphere: " + why + ", and a sphere has no image; take a cylinder along it"});
  }
}

}  // namespace

std::vector<WallFinding> findingsOf(const Project& project, const SceneWall& wall) {
  std::vector<WallFinding> found;
  for (int a = 0; a < 3; ++a) {
    if (project.environment.periodic[static_cast<size_t>(a)]) checkPeriod(wall, a, found);
  }
  const WallFace face = faceOf(wall);
  if (!face.isCurved()) return found;
  const double spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  if (face.isInside() && face.radius() < spacing) {
    found.push_back({false, "/radius",
                     "is less than a particle spacing, " + numberText(spacing) +
                         " m: no particle has room in it; make it wider, or solver/particle_spacing less"});
  } else if (face.radius() < kLeastRadius * spacing) {
    found.push_back({false, "/radius",
                     "is less than four particle spacings: so narrow a wall presses liquids only roughly; make it "
                     "wider, or solver/particle_spacing less"});
  }
  return found;
}

}  // namespace ps
