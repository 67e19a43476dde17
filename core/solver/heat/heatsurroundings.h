// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/solver/heat/heatpairs.h"
#include "core/solver/heat/opensurface.h"
#include "core/solver/heat/radiation.h"
#include "core/solver/settings.h"

#include <span>
#include <vector>

namespace ps {

/// Temperatures of a frozen instant, K, and Kirchhoff potentials, W/m.
struct HeatInstant {
  std::vector<double> potential, temperature;
  void resize(size_t count) {
    potential.resize(count);
    temperature.resize(count);
  }
};

/// Heat that came into one chunk of particles, J; `exchanged` adds up absolute amounts.
struct HeatBooks {
  double walls = 0, air = 0, radiation = 0, heaters = 0, exchanged = 0;
};

/// What lies around a particle and gives or takes heat without being a particle.
///
/// Walls: a layer of boundary matter of volume dx^3 half a spacing behind the plane, smeared out along it:
/// G = 4 k V dx A(d + dx/2), A(h) = integral of -F over the plane at distance h = 2 pi W(h). A fixed temperature holds
/// on the plane itself, and on the face of a curved wall, whose layer is curved too. Flux and convection reach a
/// particle by its share of the wall's area, A = dx2 G/G', G' that of a whole layer: on a lattice the shares add up to
/// the area exactly. Convection: 1/U = 1/h + (dx/2)/k.
///
/// Air: G = A U on free surfaces (OpenSurface) with the same U; vapour by its own size where no liquid surrounds it.
/// Wind of 2 to 20 m/s takes h = 10.45 - v + 10 sqrt(v) kcal/(m2 h K), v in m/s (Siple & Passel 1945), where that is
/// more than still air's; below 2 m/s between the two. Not modelled: air that moves by itself, lee.
///
/// Radiation of grey surfaces (Radiation): sigma eps_1 A G (T^4 - T'^4), G the share of what one sends out that the
/// other absorbs, straight or after reflections: the surroundings, walls that have a temperature, other particles.
class HeatSurroundings {
 public:
  enum class Kind { Wall, Air, Sky };
  static constexpr double kStefanBoltzmann = 5.670374419e-8;  ///< W/(m2 K4), CODATA 2018

  void configure(const ThermalSettings& settings, const SolverSettings& solver, std::vector<Wall> walls,
                 const Bounds& bounds, std::span<const BakedMaterial> materials);
  /// Once a frame, when pairs are built and temperatures are current.
  void measure(const ParticleStore& store, const api::NeighbourView& lists, const HeatPairs& pairs, uint64_t frame);
  std::span<const Wall> walls() const { return m_walls; }
  OpenSurface& surface() { return m_surface; }
  const OpenSurface& surface() const { return m_surface; }
  double narrowestGap() const { return m_radiation.narrowestGap(); }
  /// K, of the air around; a finite lump of air changes it.
  void setAir(double temperature) { m_air = temperature; }

  /// Whether matter of this temperature would exchange nothing with what lies around, which is as warm within
  /// `tolerance` K.
  bool isLike(double temperature, double tolerance) const;

  /// Conductances of particle i for the stable step: in m, to be multiplied by k, and in W/K.
  double perConductivity(size_t i) const { return m_perConductivity[i]; }
  double fixedConductance(const ParticleStore& store, size_t i) const;
  /// W/K between particle i and walls of fixed temperature, by what the matter between the two temperatures conducts:
  /// where they lie in two phases, that is another number than k times perConductivity().
  double wallConductance(const ParticleStore& store, size_t i, const HeatInstant& now) const;
  /// W/K between all matter and the air.
  double airConductance() const { return m_airTotal; }
  /// W into particle i that do not depend on its temperature: walls of given flux.
  double watts(size_t i) const { return m_watts[i]; }

  /// Calls link(Kind, W/K, K) for each thing of fixed temperature that touches or sees particle i.
  template <class Link>
  void forEach(const ParticleStore& store, size_t i, const HeatInstant& now, const Link& link) const;
  /// Calls link(partner, W/K) for each particle that i exchanges radiation with; both sides get the same number.
  template <class Link>
  void forEachInSight(size_t i, const HeatInstant& now, const Link& link) const;

 private:
  void measureOne(const ParticleStore& store, const HeatPairs& pairs, size_t i);
  void touchWalls(const ParticleStore& store, const HeatPairs& pairs, size_t i);
  double wallConductivity(const ParticleStore& store, size_t i, size_t w, const HeatInstant& now) const;
  static double linear(double t, double other) { return kStefanBoltzmann * (t * t + other * other) * (t + other); }

  ThermalSettings m_settings;
  SolverSettings m_solver;
  Bounds m_bounds;
  std::vector<Wall> m_walls;
  std::span<const BakedMaterial> m_materials;
  std::vector<double> m_emissivity;  ///< by material
  double m_air = 293.15, m_convection = 0, m_airTotal = 0, m_wholeLayer = 0;
  bool m_wallsExchange = false, m_surfaces = false;
  OpenSurface m_surface;
  SurfaceLevel m_level;
  Radiation m_radiation;
  std::vector<uint8_t> m_touches;        ///< 1: something of fixed temperature is linked to the particle
  std::vector<float> m_wallConductance;  ///< particle times walls + wall: m for fixed temperature, W/K for convection
  std::vector<float> m_airConductance;   ///< W/K
  std::vector<double> m_perConductivity, m_watts;
};

template <class Link>
void HeatSurroundings::forEach(const ParticleStore& store, size_t i, const HeatInstant& now, const Link& link) const {
  if (!m_touches[i]) return;
  const double t = now.temperature[i];
  for (size_t w = 0; w < m_walls.size(); ++w) {
    const double g = double{m_wallConductance[i * m_walls.size() + w]};
    if (!(g > 0)) continue;
    const bool fixed = m_walls[w].heat == WallHeat::FixedTemperature;
    link(Kind::Wall, fixed ? g * wallConductivity(store, i, w, now) : g, m_walls[w].temperature);
  }
  if (m_airConductance[i] > 0) link(Kind::Air, double{m_airConductance[i]}, m_air);
  if (!m_settings.radiation) return;
  if (const double area = m_radiation.sky(i); area > 0) {
    link(Kind::Sky, area * linear(t, m_settings.surroundingsTemperature), m_settings.surroundingsTemperature);
  }
  for (size_t w = 0; w < m_walls.size(); ++w) {
    const double area = m_radiation.wall(i, w), there = m_walls[w].temperature;
    if (!(area > 0)) continue;
    link(Kind::Wall, area * linear(t, there), there);
  }
}

template <class Link>
void HeatSurroundings::forEachInSight(size_t i, const HeatInstant& now, const Link& link) const {
  if (!m_settings.radiation) return;
  for (const Radiation::Sight& sight : m_radiation.sights(i)) {
    link(sight.partner, double{sight.area} * linear(now.temperature[i], now.temperature[sight.partner]));
  }
}

}  // namespace ps
