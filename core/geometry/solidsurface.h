// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/geometry/solidfill.h"
#include "core/scene/solidform.h"

#include <memory>

namespace ps {

class MeshNearest;

/// How far a place is from a solid's surface, and which way it faces there. Exact for blocks, ellipsoids and what is
/// round about its y axis, but for bowls, whose arcs are 48 straight lines each; what is oval across that axis is taken
/// as a mesh of facets, of which 96 go round.
class SolidSurface {
 public:
  explicit SolidSurface(const SolidShape& shape);
  ~SolidSurface();
  const SolidForm& form() const { return m_inside.form(); }

  struct Near {
    double distance = 0;  ///< m, negative inside
    Vector3 normal;       ///< unit, outward, of the nearest place on the surface
  };
  /// Of a place along the solid's own axes, m from its middle. May be called from any thread.
  Near at(const Vector3& own) const;

 private:
  enum class Way : uint8_t { Block, Ellipsoid, Round, Mesh };
  struct Segment {
    Eigen::Vector2d a, b;  ///< m from the axis and along it; outside is to the left of a line from a to b
  };
  Near nearBlock(const Vector3& own) const;
  Near nearEllipsoid(const Vector3& own) const;
  Near nearRound(const Vector3& own) const;
  Near nearMesh(const Vector3& own) const;
  void takeRound();
  void takeOval();

  SolidInside m_inside;
  Way m_way = Way::Block;
  std::vector<Segment> m_profile;  ///< what is swept round the y axis
  double m_swell = 0;              ///< m, how far outside of the profile the surface is
  std::shared_ptr<const MeshNearest> m_mesh;
  bool m_closed = false;  ///< the mesh
};

}  // namespace ps
