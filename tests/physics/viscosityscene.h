// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/fluid/viscosity.h"
#include "mechanicsscene.h"

#include <array>
#include <numbers>

/// What the tests of viscosity share: a syrup, the stage without a solver around it, a film on a slope.
namespace viscous {

using namespace mechanics;

inline constexpr double kPi = std::numbers::pi;

/// A liquid of 1000 kg/m3 that neither melts nor boils.
inline ps::Material syrup(double viscosity, double yieldStress = 0) {
  ps::Material m = water(1000, 1000);
  m.id = "syrup";
  m.properties["melting_temperature"] = 0.0;
  m.properties["boiling_temperature"] = 0.0;
  m.properties["viscosity"] = viscosity;
  m.properties["yield_stress"] = yieldStress;
  return m;
}

/// The stage alone, on particles that stay where they are.
struct StageScene {
  ps::ParticleStore store;
  ps::Neighbours neighbours;
  ps::DensityStage density;
  ps::ViscosityStage viscosity;
  ps::SolverSettings settings;
  std::vector<ps::Wall> walls;
  std::vector<ps::BakedMaterial> materials;

  explicit StageScene(double spacing, const std::vector<ps::Material>& list) : settings(settingsOf(spacing)) {
    for (const ps::Material& material : list) materials.emplace_back(material, 101325);
  }
  /// Returns the index of the first.
  size_t add(const std::vector<ps::api::Double3>& points, uint32_t material = 0,
             ps::api::Motion motion = ps::api::Motion::Liquid) {
    const size_t first = store.add(points.size());
    const double cell = settings.spacing * settings.spacing * settings.spacing;
    for (size_t k = 0; k < points.size(); ++k) {
      const size_t i = first + k;
      store.position()[i] = {float(points[k].x), float(points[k].y), float(points[k].z), float(cell)};
      store.mass()[i] = static_cast<float>(1000 * cell);
      store.velocity()[i] = {0, 0, 0, motion == ps::api::Motion::Static ? 0 : 1 / store.mass()[i]};
      store.motion()[i] = motion;
      store.material()[i] = material;
      store.temperature()[i] = 293.15;
      store.liquidFraction()[i] = 1;
    }
    return first;
  }
  void prepare() {
    neighbours.configure(settings.spacing * settings.supportRatio, 0.2 * settings.spacing);
    neighbours.build(store);
    density.configure(settings, walls);
    density.refresh(store, neighbours);
    viscosity.configure(settings, walls, materials);
    viscosity.refresh(store, neighbours, density);
  }
  void apply() { viscosity.apply(store, neighbours, density); }
};

struct Momenta {
  std::array<double, 3> linear{}, angular{};  ///< kg m/s, kg m2/s about the origin
  double absolute = 0, energy = 0;            ///< sum of m |v|, J
};

inline Momenta momentaOf(const ps::ParticleStore& store, size_t first, size_t last) {
  Momenta t;
  for (size_t i = first; i < last; ++i) {
    const ps::api::Float4 &p = store.position()[i], &u = store.velocity()[i];
    const double m = store.mass()[i], x[3] = {p.x, p.y, p.z}, v[3] = {m * u.x, m * u.y, m * u.z};
    for (size_t a = 0; a < 3; ++a) {
      const size_t b = (a + 1) % 3, c = (a + 2) % 3;
      t.linear[a] += v[a];
      t.angular[a] += x[b] * v[c] - x[c] * v[b];
      t.energy += v[a] * v[a] / (2 * m);
    }
    t.absolute += std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  return t;
}

/// The same numbers in [-1, 1) on every machine.
class Noise {
 public:
  double operator()() {
    m_state = m_state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(m_state >> 33) / 1073741824.0 - 1;
  }

 private:
  uint64_t m_state = 1;
};

/// A film of eight layers of 25 mm on a plane that leans by 10 degrees, four particles wide between planes of symmetry,
/// five metres long, since there are no periodic boundaries: what happens at its ends does not reach the middle half
/// metre in the time given (waves of the surface travel at most at 3 mean speeds). Gravity leans instead of the plane.
struct Film {
  static constexpr double kHeight = 0.2, kSpacing = 0.025, kLean = 10 * kPi / 180, kGravity = 9.81;
  double surface = 0, mean = 0;  ///< m/s along the slope, of the topmost layer and of all
};

/// `noSlip`: of the bed. Fails the test by a negative speed when a flag is raised.
inline Film filmAfter(double seconds, double viscosity, double yieldStress, double length, bool noSlip = true) {
  ps::Solver solver;
  ps::SolverSettings settings = settingsOf(Film::kSpacing);
  settings.iterations = 2;
  settings.gravity = {Film::kGravity * std::sin(Film::kLean), -Film::kGravity * std::cos(Film::kLean), 0};
  prepare(solver, settings, syrup(viscosity, yieldStress));
  ps::Bounds bounds;
  bounds.minimum = {-10, -1, -1};
  bounds.maximum = {10, 1, 1};
  solver.setBounds(bounds);
  std::vector<ps::Wall> walls = tray(4 * Film::kSpacing);
  walls.erase(walls.begin() + 1, walls.begin() + 3);
  walls[0].noSlip = noSlip;
  walls[1].noSlip = walls[2].noSlip = false;
  solver.setWalls(walls);
  solver.spawn(liquid(lattice(static_cast<int>(std::lround(length / Film::kSpacing)), 8, 4, Film::kSpacing, 0)));
  if (!run(solver, static_cast<int>(std::lround(seconds * 60)))) return {-1, -1};
  Film film;
  double top = 0, all = 0;
  const ps::ParticleStore& p = solver.particles();
  for (size_t i = 0; i < p.size(); ++i) {
    if (std::abs(p.position()[i].x) > 0.25f) continue;
    const double v = p.velocity()[i].x;
    film.mean += v, all += 1;
    if (p.position()[i].y > Film::kHeight - Film::kSpacing) film.surface += v, top += 1;
  }
  return {film.surface / top, film.mean / all};
}

}  // namespace viscous
