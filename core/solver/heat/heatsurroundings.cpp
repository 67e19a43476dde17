// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/heatsurroundings.h"

#include "core/base/parallelarrays.h"
#include "core/solver/contact/wallplane.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace ps {
namespace {

/// Frames from one look for free surfaces to the next.
constexpr uint64_t kSurfaceFrames = 4;
constexpr double kGentle = 2, kStrong = 20;  ///< m/s, where the law of wind holds

/// Volume^(2/3), m2, for a volume near spacing^3. Newton's cube root, because the C library's may differ in its last
/// bit between machines.
double faceOf(double volume, double spacing) {
  const double scaled = volume / (spacing * spacing * spacing);
  double x = 1;
  for (int k = 0; k < 6; ++k) x = (2 * x + scaled / (x * x)) / 3;
  return x * x * spacing * spacing;
}

/// W/(m2 K) of a law in kcal/(m2 h K).
double windChill(double speed) { return 1.163 * (10.45 - speed + 10 * std::sqrt(speed)); }

/// W/(m2 K) with the wind's share; without still air's there is no air to take heat.
double convectionIn(double still, double wind) {
  if (!(still > 0)) return 0;
  if (wind < kGentle) return still + wind / kGentle * (std::max(still, windChill(kGentle)) - still);
  return std::max(still, windChill(std::min(wind, kStrong)));
}

/// W/(m2 K) of a film of air or water and the half spacing of matter behind it.
double inSeries(double film, double conductivity, double spacing) {
  if (!(film > 0) || !(conductivity > 0)) return 0;
  return 1 / (1 / film + 0.5 * spacing / conductivity);
}

/// How much more of a curved layer `behind` m behind a wall's face is seen from `depth` m before that layer than of a
/// plane one: of a sphere R'/(R' - depth), exactly, of a cylinder the root of that, to first order in depth/R'.
double spreadOf(const Bend& bend, double depth, double behind) {
  if (bend.radius == 0) return 1;
  const double radius = bend.radius + behind;    // below 0 where matter is outside
  if (bend.radius < 0 && radius >= 0) return 0;  // there is no such layer
  const double spread = radius / (radius < 0 ? radius - depth : std::max(radius - depth, 0.5 * radius));
  return bend.share < 1 ? std::sqrt(spread) : spread;
}

}  // namespace

void HeatSurroundings::configure(const ThermalSettings& settings, const SolverSettings& solver, std::vector<Wall> walls,
                                 const Bounds& bounds, std::span<const BakedMaterial> materials) {
  m_settings = settings;
  m_solver = solver;
  m_bounds = bounds;
  m_walls = std::move(walls);
  m_materials = materials;
  m_emissivity.clear();
  for (const BakedMaterial& material : materials) m_emissivity.push_back(material.property("emissivity", 293.15));
  m_wallsExchange =
      std::any_of(m_walls.begin(), m_walls.end(), [](const Wall& wall) { return wall.heat != WallHeat::Adiabatic; });
  const api::Double3& wind = solver.wind;
  m_convection = convectionIn(settings.airConvection, std::sqrt(wind.x * wind.x + wind.y * wind.y + wind.z * wind.z));
  m_surfaces = m_convection > 0 || settings.radiation;
  const double dx = solver.spacing;
  const Kernel kernel(solver.kernel, dx * solver.supportRatio);
  m_level = SurfaceLevel::of(kernel, dx);
  m_wholeLayer = 0;
  for (int layer = 1; layer <= 4; ++layer) m_wholeLayer += kernel.value(layer * dx);
  m_wholeLayer *= 4 * dx * dx * dx * dx * 2 * std::numbers::pi;
  m_surface.forget();
  m_radiation.forgetBoxes();
  if (!settings.radiation) m_radiation.forget();
}

void HeatSurroundings::measure(const ParticleStore& store, const api::NeighbourView& lists, const HeatPairs& pairs,
                               uint64_t frame) {
  const size_t n = store.size();
  m_touches.resize(n);
  assignAll(m_wallConductance, n * m_walls.size(), 0.0f);
  m_airConductance.resize(n);
  m_perConductivity.resize(n);
  m_watts.resize(n);
  if (m_surfaces && (frame % kSurfaceFrames == 0 || !m_surface.fits(store)))
    m_surface.measure(store, lists, pairs.filled, m_walls, m_solver.spacing, m_settings.surfaceArea);
  if (m_settings.radiation) {
    m_radiation.trace({store, lists, pairs.filled, m_surface, m_level, m_walls, m_emissivity, m_settings.surfaceArea,
                       m_bounds, m_solver.spacing, frame});
  }
  const auto measureSome = [&](size_t first, size_t last) {
    double sum = 0;
    for (size_t i = first; i < last; ++i) {
      measureOne(store, pairs, i);
      sum += double{m_airConductance[i]};
    }
    return sum;
  };
  m_airTotal = parallelSum(n, grain::kNeighbours, std::cref(measureSome));
}

bool HeatSurroundings::isLike(double temperature, double tolerance) const {
  const auto isNear = [&](double other) { return std::abs(other - temperature) < tolerance; };
  if (m_convection > 0 && !isNear(m_air)) return false;
  if (m_settings.radiation && !isNear(m_settings.surroundingsTemperature)) return false;
  return std::all_of(m_walls.begin(), m_walls.end(), [&](const Wall& wall) {
    if (wall.heat == WallHeat::FixedFlux) return wall.flux == 0;
    return wall.heat == WallHeat::Adiabatic || isNear(wall.temperature);
  });
}

void HeatSurroundings::measureOne(const ParticleStore& store, const HeatPairs& pairs, size_t i) {
  const double dx = m_solver.spacing, gas = double{store.gasFraction()[i]};
  m_perConductivity[i] = 0;
  m_watts[i] = 0;
  m_touches[i] = 0;
  if (m_wallsExchange && !pairs.isInsulated(i)) touchWalls(store, pairs, i);
  double air = 0;
  if (gas > 0) {
    const double open = std::max(0.0, 1 - 2 * double{pairs.immersion[i]});
    air = open * gas * m_convection * faceOf(store.position()[i].w, dx);
  }
  if (m_surfaces && m_convection > 0 && gas < 1)
    air += (1 - gas) * m_surface.area(i) * inSeries(m_convection, pairs.conductivity[i], dx);
  if (pairs.isInsulated(i)) air = 0;
  m_airConductance[i] = static_cast<float>(air);
  m_touches[i] |= air > 0 || (m_settings.radiation && m_radiation.emits(i));
}

void HeatSurroundings::touchWalls(const ParticleStore& store, const HeatPairs& pairs, size_t i) {
  const double dx = m_solver.spacing, volume = pairs.volume[i];
  const Kernel kernel(m_solver.kernel, dx * m_solver.supportRatio);
  const api::Float4 x = store.position()[i];
  for (size_t w = 0; w < m_walls.size(); ++w) {
    const Wall& wall = m_walls[w];
    if (wall.heat == WallHeat::Adiabatic) continue;
    const double depth = std::max(heightOver(wall, x), 0.0) + 0.5 * dx;
    const double g =
        4 * volume * dx * 2 * std::numbers::pi * kernel.value(depth) * spreadOf(bendOf(wall), depth, 0.5 * dx);
    if (!(g > 0)) continue;
    const double area = dx * dx * g / m_wholeLayer;
    double conductance = 0;
    switch (wall.heat) {
      case WallHeat::FixedTemperature:
        conductance = g;
        m_perConductivity[i] += g;
        break;
      case WallHeat::Convective:
        conductance = area * inSeries(wall.convection, pairs.conductivity[i], dx);
        break;
      default:
        m_watts[i] += area * wall.flux;
    }
    m_wallConductance[i * m_walls.size() + w] = static_cast<float>(conductance);
    m_touches[i] |= conductance > 0;
  }
}

double HeatSurroundings::fixedConductance(const ParticleStore& store, size_t i) const {
  double sum = double{m_airConductance[i]};
  const double t = store.temperature()[i];
  if (m_settings.radiation) {
    for (const Radiation::Sight& sight : m_radiation.sights(i))
      sum += double{sight.area} * linear(t, store.temperature()[sight.partner]);
  }
  if (!m_touches[i]) return sum;
  for (size_t w = 0; w < m_walls.size(); ++w) {
    if (m_walls[w].heat == WallHeat::Convective) sum += double{m_wallConductance[i * m_walls.size() + w]};
  }
  if (!m_settings.radiation) return sum;
  sum += m_radiation.sky(i) * linear(t, m_settings.surroundingsTemperature);
  for (size_t w = 0; w < m_walls.size(); ++w) {
    if (const double area = m_radiation.wall(i, w); area > 0) sum += area * linear(t, m_walls[w].temperature);
  }
  return sum;
}

double HeatSurroundings::wallConductance(const ParticleStore& store, size_t i, const HeatInstant& now) const {
  if (!(m_perConductivity[i] > 0)) return 0;
  double sum = 0;
  for (size_t w = 0; w < m_walls.size(); ++w) {
    const double g = double{m_wallConductance[i * m_walls.size() + w]};
    if (g > 0 && m_walls[w].heat == WallHeat::FixedTemperature) sum += g * wallConductivity(store, i, w, now);
  }
  return sum;
}

/// Mean conductivity between particle i and wall w, W/(m K): the Kirchhoff mean, as inside matter, up to the boiling
/// (or sublimation) point. Beyond it the matter that touches the wall conducts as itself, not as the vapour that
/// Kirchhoff's integral would put between them: a film of vapour insulates only as far as the particle itself has
/// become vapour.
double HeatSurroundings::wallConductivity(const ParticleStore& store, size_t i, size_t w,
                                          const HeatInstant& now) const {
  const BakedMaterial& material = m_materials[store.material()[i]];
  const api::Caloric& caloric = material.caloric();
  const double boiling = caloric.sublimes ? caloric.meltingPoint : caloric.boilingPoint;
  const double here = now.temperature[i], there = m_walls[w].temperature;
  const double gas = double{store.gasFraction()[i]};
  if (std::abs(there - here) < 1e-9)
    return material.conductivity(here, store.solidFraction()[i], store.liquidFraction()[i], gas);
  if (here <= boiling && there <= boiling) return (material.kirchhoff(there) - now.potential[i]) / (there - here);
  const double solid = caloric.sublimes ? 1 : 0;
  const double k =
      (1 - gas) * material.conductivity(boiling, solid, 1 - solid, 0) + gas * material.conductivity(boiling, 0, 0, 1);
  const double drive = material.kirchhoff(std::min(there, boiling)) - material.kirchhoff(std::min(here, boiling)) +
                       k * (std::max(there, boiling) - std::max(here, boiling));
  return drive / (there - here);
}

}  // namespace ps
