// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/meshnearest.h"
#include "core/math/rigidmove.h"

#include <memory>

namespace ps {

/// The surface of a fixed body. Fluids meet it in place of the body's particles, for as long as all of these are where
/// the shape has them: see field::kShapePlace.
struct FixedShape {
  uint32_t body = 0;
  std::shared_ptr<const MeshNearest> surface;  ///< m, along the shape's own axes
  bool closed = true;                          ///< it has an inside, in which nothing can be
  RigidMove pose;                              ///< from its own axes to the scene
  uint64_t stamp = 0;                          ///< of the shape without its pose
};

namespace field {

/// Float4 of the particles of fixed bodies whose shape is known: their place along its own axes, m, and what markOf()
/// says of it and of how many of them there were at the start. Only stores of scenes with such shapes have it.
inline constexpr const char* kShapePlace = "shape_place";

}  // namespace field

/// Another one of another shape, or of other numbers of particles; of what a float holds exactly.
inline float markOf(uint64_t stamp, size_t particles) {
  const uint64_t mixed = (stamp ^ particles) * 0x9E3779B97F4A7C15u;
  return static_cast<float>(mixed >> 40);
}

}  // namespace ps
