// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"
#include "core/particles/particlestore.h"
#include "core/solver/heat/opensurface.h"
#include "core/solver/settings.h"

#include <span>
#include <vector>

namespace ps {

/// Who sees whom, for heat radiated between grey surfaces. Rays leave each particle that has a surface (OpenSurface)
/// until they meet matter, a wall, or leave the scene. Each carries a part of the particle's area, by Lambert's cosine
/// law about the surface's normal, the mean of its open directions; where these point to all sides, as those of a drop,
/// by them. A ray that meets a particle couples the two both ways with half its area, so that what one gains the other
/// loses to the last bit; the other half comes from the rays that go back. Up to kRays rays a frame: with a large
/// surface each frame follows part of the directions, and some frames all of them.
///
/// Walls that let no heat through are mirrors, as far as the scene's bounds reach: beyond, what would meet them has
/// left the scene, since walls are endless and a tray is not.
///
/// It cannot do: reflection by matter and warm walls (what is not absorbed at the first meeting stays with its source,
/// exact between parallel plates only), vapour and flames that radiate or shade, gaps of less than three spacings.
class Radiation {
 public:
  static constexpr size_t kRays = 65536;

  /// `frame` chooses the directions where not all are followed.
  void trace(const ParticleStore& store, const OpenSurface& surface, std::span<const Wall> walls, const Bounds& bounds,
             double spacing, uint64_t frame);
  void forget();

  /// Area in m2 with which particle i sees partner.
  struct Sight {
    uint32_t partner;
    float area;
  };
  std::span<const Sight> sights(size_t i) const { return {m_sights.data() + m_begin[i], m_begin[i + 1] - m_begin[i]}; }
  /// m2 through which particle i sees what surrounds the scene.
  double sky(size_t i) const { return m_sky[i]; }
  /// m2 with which it sees a wall.
  double wall(size_t i, size_t w) const { return m_wall[i * m_walls + w]; }

 private:
  /// Occupied cells of about a spacing, each with the lowest index of the particles in it.
  struct Grid {
    static constexpr uint32_t kEmpty = 0xffffffffu;
    double low[3] = {}, high[3] = {}, edge[3] = {};  ///< m
    int count[3] = {1, 1, 1};
    double near = 0;  ///< m, around a particle, within which rays pass what is there
    bool repeats[3] = {};
    std::vector<uint32_t> cells;

    void build(const ParticleStore& store, double spacing);
    /// First particle within `longest` m of `from` along the unit vector `way`, but those that lie about `self`;
    /// kEmpty: none.
    uint32_t firstOn(const ParticleStore& store, const Vector3& from, const Vector3& way, double longest,
                     uint32_t self) const;
    /// Whether a ray along `way` comes out anywhere: not between the faces of a period.
    bool comesOut(const Vector3& way) const {
      return (!repeats[0] && way.x() != 0) || (!repeats[1] && way.y() != 0) || (!repeats[2] && way.z() != 0);
    }

   private:
    bool about(const ParticleStore& store, uint32_t self, uint32_t other) const;
    void span(const ParticleStore& store, double spacing);
    void fill(const ParticleStore& store, double spacing);
  };
  /// Where a ray ends: at a particle, at a wall that has a temperature, outside, or nowhere.
  struct End {
    uint32_t particle;
    size_t wall;
    bool sky;
  };
  End endOf(const ParticleStore& store, std::span<const Wall> walls, Vector3 from, Vector3 way, uint32_t self) const;
  void follow(const ParticleStore& store, const OpenSurface& surface, std::span<const Wall> walls, double spacing,
              uint64_t frame, size_t first, size_t last);
  void couple(size_t count);

  Grid m_grid;
  Bounds m_bounds;
  double m_spacing = 0;  ///< m
  size_t m_walls = 0, m_perParticle = 64;
  std::vector<uint32_t> m_emitters;  ///< particles with a surface
  std::vector<uint32_t> m_met;       ///< per ray: the particle it met, or kEmpty
  std::vector<float> m_area;         ///< per ray, m2
  std::vector<size_t> m_begin, m_next;
  std::vector<Sight> m_sights;
  std::vector<float> m_sky, m_wall;
};

}  // namespace ps
