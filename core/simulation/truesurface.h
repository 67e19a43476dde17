// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"
#include "core/scene/project.h"
#include "core/solver/fixedshape.h"

#include <map>
#include <optional>
#include <span>
#include <string>

namespace ps {

/// Whether contact may follow a body's shape: a solid that is fixed and stands, and is packed or a turned block, whose
/// lattice lies along its faces. Else on a lattice its particles lie as far out as the surface itself, where what is
/// fast would meet them first.
bool hasTrueSurface(const Body& body);
/// Writes field::kTrueSurface of a body's particles that lie within a spacing of its surface.
void noteTrueSurface(ParticleStore& store, std::span<const uint32_t> ids, const Body& body, double spacing);

/// The surfaces that fluids meet in place of a body's particles: of every fixed solid but sheets and ropes. What was
/// made is kept for as long as a body has that shape.
class ShapeSurfaces {
 public:
  /// Of a body that is fixed, by its index; none of what is no such solid.
  std::optional<FixedShape> of(const Body& body, uint32_t index, double spacing);
  /// m2 of a body's shape, of what is one layer thick on one side; 0 of sketches and ropes, whose cells alone show it.
  double areaOf(const Body& body, double spacing);
  /// Writes field::kShapePlace of all particles of such a body, as they are born.
  void note(ParticleStore& store, std::span<const uint32_t> ids, const Body& body, double spacing);

 private:
  struct Known {
    SolidShape upright;
    double spacing = 0;
    FixedShape shape;
  };
  struct Area {
    SolidShape upright;
    double spacing = 0, area = 0;
  };
  std::map<std::string, Known> m_known;  ///< by id of the body
  std::map<std::string, Area> m_areas;   ///< likewise
};

}  // namespace ps
