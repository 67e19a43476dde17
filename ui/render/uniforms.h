// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

#include <array>

namespace ps::render {

inline std::array<float, 3> floats(const Vector3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// The uniform block of frame.glsl, std140.
struct FrameUniforms {
  using Matrix = std::array<float, 16>;
  using Four = std::array<float, 4>;
  Matrix view, projection, inverseView, shadow;
  Four eye, size, lens, light, plate, ground, contact, matter, glowTint;
};

}  // namespace ps::render
