// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace ps {

/// A closed surface of triangles, counterclockwise as seen from outside.
struct ParticleSurface {
  std::vector<std::array<float, 3>> points, normals;  ///< m; of length 1, outwards
  std::vector<float> values;                          ///< by point
  std::vector<std::array<uint32_t, 3>> triangles;
};

/// The surface of matter given as spheres (m; w: radius of the volume at rest), with a number of each sphere carried
/// over to it. Level set of Zhu & Bridson (2005, eqs. 5 to 7): a place x is inside where it is nearer to the weighted
/// mean of the centres around it than to that of the radii; a row of spheres becomes one smooth body. They look as far
/// as lets a half-space of matter end where it ends, which also leaves a lone sphere what it is. Their known fault,
/// matter in the middle between two bodies, is cut off: a place farther from every centre than matter at rest leaves
/// between its particles is outside. Triangles by surface nets (Gibson 1998) over a lattice of cells of `cell` m that
/// begins at the origin, so that a surface at rest is the same in every frame; lattices are made only where there is
/// matter. What is flat lies where it should to a tenth of a spacing; edges are rounded: a ball of 16 spheres across
/// has 96 % of its volume, a cube of ten along an edge 91 %. The same bits for any number of threads. Advances the
/// thread's progress; throws Cancelled.
ParticleSurface surfaceAround(std::span<const api::Float4> spheres, std::span<const float> values, double cell);

}  // namespace ps
