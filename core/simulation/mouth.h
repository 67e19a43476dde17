// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <vector>

namespace ps {

/// How a round mouth is filled with whole particles. Places that lie within the circle are seldom as many as its area
/// asks for (five, in one of two spacings, for an area of 3.14), so layers follow each other by more or less than a
/// spacing: what crosses the mouth is speed times area at any spacing.
struct Mouth {
  std::vector<std::array<double, 2>> places;  ///< m across the jet, from its axis
  double pitch = 0;                           ///< m from one layer to the next
};

/// Of a mouth `diameter` m wide and particles `spacing` m apart: the square lattice, with a particle, the middle of an
/// edge or that of a cell on the axis, whose number of places is nearest to the area. One that is narrower than a
/// particle drips.
Mouth mouthOf(double diameter, double spacing);

}  // namespace ps
