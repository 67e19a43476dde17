// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/furniture.h"
#include "ui/render/uniforms.h"

#include <array>
#include <cstdint>
#include <optional>

namespace ps::render {

extern const Vector3 kKeyLight;  ///< towards it, a unit vector: high, from the left and front of the usual view

/// What there is to draw between two snapshots, from wherever it is seen.
struct Prepared {
  Look look;
  Instances instances;
  Furniture furniture;
  Props props;
  Extent propsExtent;              ///< of what is opaque of them
  std::vector<EdgeVertex> guides;  ///< triangles
  uint64_t furnitureRevision = 0;  ///< another one with every change of `furniture`, of any of these
  ContactMap contact;
  FrameUniforms::Matrix toLight{}, shadow{};  ///< world to clip space of the shadow picture, and to its texture
  std::array<float, 2> shadowScale{};         ///< metres to clip space
  float time = 0;                             ///< s, without whole hours: it only turns clouds
  bool data = false;                          ///< colours show data
  bool ready = false;

  void fill(const Snapshot& now, const Snapshot* previous, double blend, const RenderScene& scene, const Look& how);
  void show(const Props& what);
  void takeProps(Prepared& other);  ///< in exchange

 private:
  void furnish(const Environment& environment);
  void collect(const Snapshot& now, const Snapshot* previous, double blend);
  void placeContactMap();
  void fitShadow();

  std::optional<Environment> m_furnished;  // what `furniture` was made of, for which theme and section
  bool m_dark = false;
  std::optional<Section> m_section;
};

FrameUniforms::Matrix uniformOf(const Matrix4& a);

}  // namespace ps::render
