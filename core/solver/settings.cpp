// SPDX-License-Identifier: Apache-2.0
#include "core/solver/settings.h"

#include "core/particles/neighbours.h"

namespace ps {

double leastPeriod(const SolverSettings& settings) {
  return Neighbours::leastPeriod((settings.supportRatio + kSkinSpacings) * settings.spacing);
}

WallFace faceOf(const Wall& wall, double inset) {
  WallFace face(Plane{vectorOf(wall.normal), wall.offset});
  if (wall.form == WallForm::Cylinder)
    face = WallFace::cylinder(vectorOf(wall.centre), vectorOf(wall.normal), wall.radius, wall.inside);
  if (wall.form == WallForm::Sphere) face = WallFace::sphere(vectorOf(wall.centre), wall.radius, wall.inside);
  return face.before(inset);
}

}  // namespace ps
