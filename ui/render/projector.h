// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ps::render {

/// Many points of the world to pixels of one picture, in floats.
class Projector {
 public:
  /// Pixels from the upper left corner, and depth along the view in m; nearer than near() the pixels mean little.
  struct Place {
    float x, y, depth;
  };
  struct Radii {
    float least, most;  ///< pixels
  };

  Projector(const Eye& eye, int width, int height)
      : m_matrix((eye.projection * eye.view).cast<float>()),
        m_width(static_cast<float>(width)),
        m_height(static_cast<float>(height)),
        m_near(static_cast<float>(nearPlane(eye))),
        m_tangent{static_cast<float>(1 / eye.projection(0, 0)), static_cast<float>(1 / eye.projection(1, 1))},
        m_centre{static_cast<float>(eye.projection(0, 2)), static_cast<float>(eye.projection(1, 2))},
        m_lens{m_width / (2 * m_tangent[0]), m_height / (2 * m_tangent[1])} {}

  float width() const { return m_width; }
  float height() const { return m_height; }
  float near() const { return m_near; }

  Place at(float x, float y, float z) const {
    const auto row = [&](int r) {
      return m_matrix(r, 0) * x + m_matrix(r, 1) * y + m_matrix(r, 2) * z + m_matrix(r, 3);
    };
    const float w = row(3), safe = std::max(w, m_near);
    return {(row(0) / safe * 0.5f + 0.5f) * m_width, (0.5f - row(1) / safe * 0.5f) * m_height, w};
  }

  /// Half axes of the ellipse that a sphere's picture is: the farther off the line of sight, the longer.
  Radii radiiOf(float radius, const Place& at) const {
    const float depth = std::max(at.depth, m_near);
    const float tx = (at.x / m_width * 2 - 1 + m_centre[0]) * m_tangent[0];
    const float ty = (1 - at.y / m_height * 2 + m_centre[1]) * m_tangent[1];
    return {radius * std::min(m_lens[0], m_lens[1]) / depth,
            radius * std::max(m_lens[0], m_lens[1]) / depth * std::sqrt(1 + tx * tx + ty * ty)};
  }

 private:
  Eigen::Matrix4f m_matrix;
  float m_width, m_height, m_near;
  std::array<float, 2> m_tangent, m_centre;  // half the window's size at a depth of 1, and how far it is off the axis
  std::array<float, 2> m_lens;               // pixels of a metre at a depth of 1 m
};

}  // namespace ps::render
