// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/kernels.h"
#include "core/math/vector.h"
#include "core/particles/particlestore.h"
#include "core/solver/heat/opensurface.h"
#include "core/solver/settings.h"

#include <array>
#include <cstdint>
#include <span>

namespace ps {

/// Where the surface lies before a particle, by how much of the space around it is filled.
struct SurfaceLevel {
  double flat = 0.85;  ///< sum of V W of a lattice's outermost centres, half a spacing below its surface
  double slope = 1.6;  ///< spacings by which the surface is further away, for each 1 of that sum more
  /// From two planes of a lattice, along its axes and at 45 degrees, whose outermost centres lie half a layer below.
  static SurfaceLevel of(const Kernel& kernel, double spacing);
  double heightOf(double filled) const;  ///< spacings
};

/// A particle at a surface as the cube of a spacing that it stands for, turned with the lattice around it: the bare
/// faces of a body's cubes are the body's surface, half a spacing beyond the outermost centres, with an edge's two and
/// a corner's three.
///
/// On a lattice, in any position, a face is bare where no particle, of whatever body, lies before it within one and a
/// half spacings, and no wall stands; the area is a spacing squared for each. Where it rises in steps, as a ball's or a
/// slope does, the cube of a step is turned to the mean of the particle's open directions, its front put where the
/// surface is by what is filled, and the area taken of the slope on which so many faces are bare. So is in disorder,
/// with the area that OpenSurface finds.
struct SurfaceBox {
  std::array<std::array<float, 3>, 3> axes{};  ///< unit vectors, at right angles to each other
  uint8_t bare = 0;                            ///< bit 2 a: the face along axis a; 2 a + 1: the one against it
  bool asksTemperature = false;                ///< of a body at a gap's distance before a face: `gap` follows from it
  bool turned = false;  ///< to the open directions, which face 0 is across; else with the lattice
  uint32_t particle = 0;
  float height = 0.5f;  ///< spacings to face 0; 0.5 to others
  float area = 0;       ///< m2, of all bare faces
  float gap = 0;        ///< m to a warmer or colder body before a face, where it is less than a spacing; 0: none is

  Vector3 axis(size_t a) const { return {axes[a][0], axes[a][1], axes[a][2]}; }
  /// Outward normal of face 0 .. 5.
  Vector3 normal(size_t face) const { return face % 2 == 0 ? axis(face / 2) : Vector3(-axis(face / 2)); }
  bool isBare(size_t face) const { return (bare >> face & 1) != 0; }
  /// Sum of the normals of the bare faces.
  Vector3 meanNormal() const;
};

/// What a box is found from.
struct SurfaceSurroundings {
  const ParticleStore& store;
  std::span<const Wall> walls;
  const OpenSurface& surface;
  std::span<const float> filled;  ///< sum of V W of each particle
  SurfaceLevel level;
  double spacing;  ///< m
};

/// `near`: the particle's neighbours within boxReach(), in any order, which changes no bit, and perhaps more.
SurfaceBox surfaceBoxOf(const SurfaceSurroundings& around, std::span<const uint32_t> near, uint32_t particle);
/// Spacings; nothing farther away changes a box.
double boxReach();

}  // namespace ps
