// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/math/wallface.h"
#include "core/particles/particlestore.h"
#include "core/solver/heat/opensurface.h"
#include "core/solver/heat/raygrid.h"
#include "core/solver/heat/surfaceboxes.h"
#include "core/solver/settings.h"

#include <span>
#include <vector>

namespace ps {

class RaySamples;

/// What radiates in a frame, and what stands around it.
struct RadiationScene {
  const ParticleStore& store;
  const api::NeighbourView& lists;
  std::span<const float> filled;  ///< sum of V W of each particle
  const OpenSurface& surface;
  SurfaceLevel level;
  std::span<const Wall> walls;
  std::span<const double> emissivity;  ///< by material
  std::span<const double> givenArea;   ///< m2 by index of body; 0, or none: that of its particles' faces
  Bounds bounds;
  double spacing;  ///< m
  uint64_t frame;  ///< chooses the rays
};

/// Who sees whom, for heat radiated between grey surfaces: Monte Carlo rays (Howell 1969; Siegel & Howell, Thermal
/// Radiation Heat Transfer) from points spread evenly over the bare faces of what lies at a surface (SurfaceBox), by
/// Lambert's cosine law, until matter or a wall absorbs them, or they leave the scene. Each carries its part of the
/// particle's area, times its emissivity; what it meets absorbs it with the probability of its own emissivity, or
/// sends it on: matter to all sides, a wall as a mirror. A ray that ends at a particle couples the two both ways with
/// half its area, so that what one gains the other loses to the last bit; the other half comes from the rays that go
/// back, since e1 A1 G12 = e2 A2 G21. Up to kRays rays a frame, others in each: what is exchanged scatters from frame
/// to frame, never between what is equally warm.
///
/// Turned cubes reach over each other: what of a face lies under those of its own body is left out, and what is turned
/// itself passes matter nearby that is of its body or faces the same way. A body of given area shares it out by what is
/// left.
///
/// Walls that let no heat through are mirrors, as far as the scene's bounds reach: beyond, what would meet them has
/// left the scene, since walls are endless and a tray is not.
///
/// It cannot do: vapour and flames that radiate or shade; gaps of less than half a spacing, which count as closed (up
/// to one spacing matter conducts across as well: narrowestGap()); what is round within a few spacings, which is too
/// large by a third of a spacing.
class Radiation {
 public:
  static constexpr size_t kRays = 8192;

  void trace(const RadiationScene& scene);
  /// Walls or numbers have changed.
  void forgetBoxes() { m_found.forget(); }
  void forget();

  /// Area in m2, times emissivities, with which particle i sees partner.
  struct Sight {
    uint32_t partner;
    float area;
  };
  std::span<const Sight> sights(size_t i) const { return {m_sights.data() + m_begin[i], m_begin[i + 1] - m_begin[i]}; }
  /// m2, times emissivity, through which particle i sees what surrounds the scene.
  double sky(size_t i) const { return m_sky[i]; }
  /// m2, times emissivities, with which it sees a wall.
  double wall(size_t i, size_t w) const { return m_wall[i * m_walls + w]; }
  /// m between the surfaces of two bodies of different temperature that stand half a spacing to a spacing apart, the
  /// least of all; 0: none do.
  double narrowestGap() const { return m_narrowestGap; }
  /// Whether particle i has a bare face.
  bool emits(size_t i) const { return m_boxOf[i] != RayGrid::kNone && m_boxes[m_boxOf[i]].bare != 0; }

 private:
  /// Where a ray ends: at a particle, at a wall that has a temperature, outside, or nowhere.
  struct End {
    uint32_t particle;
    size_t wall;
    bool sky;
    bool covered;  ///< begins under a turned cube of its own body
  };
  /// A ray on its way.
  struct Ray {
    Vector3 from, way;
    uint32_t source;  ///< particle from which it comes, or by which it was reflected last
    bool first;       ///< not reflected yet
    bool straight;    ///< no mirror since its source
    uint32_t chance;
  };
  void findBoxes(const RadiationScene& scene);
  void follow(const RadiationScene& scene, size_t first, size_t last);
  void followOne(const RadiationScene& scene, size_t emitter, const RaySamples& samples, size_t k);
  End endOf(const RadiationScene& scene, Ray ray) const;
  bool passes(const RadiationScene& scene, const Ray& ray, const RayGrid::Hit& hit) const;
  bool isCovered(const RadiationScene& scene, const Ray& ray, const RayGrid::Hit& hit) const;
  bool isNear(const RadiationScene& scene, uint32_t one, uint32_t other) const;
  /// Sends a ray on from the particle that it has met.
  bool reflect(const RadiationScene& scene, const RayGrid::Hit& hit, Ray& ray) const;
  void scaleToBodies(const RadiationScene& scene);
  void couple(size_t count);

  /// A wall as rays meet it.
  struct Mirror {
    WallFace face;
    bool exchanges;  ///< has a temperature
  };
  /// The wall that a ray would meet first, its number where there is none, and how far it is.
  std::pair<size_t, double> nearestWall(const Ray& ray) const;

  RayGrid m_grid;
  std::vector<Mirror> m_mirrors;  ///< by wall
  SurfaceBoxes m_found;
  std::vector<SurfaceBox> m_boxes;
  std::vector<uint32_t> m_boxOf;  ///< by particle, or RayGrid::kNone
  size_t m_walls = 0, m_perParticle = 64;
  double m_narrowestGap = 0;         ///< m
  std::vector<uint32_t> m_emitters;  ///< indices of boxes with bare faces
  std::vector<uint32_t> m_met;       ///< per ray: the particle it met, or RayGrid::kNone
  std::vector<float> m_area;         ///< per ray, m2
  std::vector<float> m_outer;        ///< per emitter: m2 of rays that do not begin covered
  std::vector<double> m_areaOf;      ///< m2 by body
  std::vector<size_t> m_begin, m_next;
  std::vector<Sight> m_sights;
  std::vector<float> m_sky, m_wall;
};

}  // namespace ps
