// SPDX-License-Identifier: Apache-2.0
// What viscosity cannot deliver: beyond its reach, and of films on walls and on fixed matter.
#include "core/base/parallel.h"
#include "core/solver/fluid/viscosity.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Layers of a film that are looked at, and fewer than which tell: a film of n layers is faster by 0.27/n (measured:
/// 0.27 of one, 0.10 to 0.16 of two, 0.05 to 0.09 of three).
constexpr float kNearLayers = 4;
constexpr double kFewLayers = 2.5, kThin = 0.27;
/// Likewise on fixed particles, into whose hollows the first layer sinks (measured: 0.18 of two, 0.22 of three, 0.08 of
/// four, 0.02 of six).
constexpr double kFewOnBed = 3.5, kThinOnBed = 0.6;
constexpr double kTouching = 1.25;  ///< spacings to a fixed particle, within which a layer is the first
constexpr double kFlat = 0.5;       ///< spacings, root of the mean square by which the first layer of a film is uneven
/// Slopes, as tangents: what is no slope, below which layers of particles in order hold a film to a tenth, up to which
/// they hold it altogether but for a creeping share of its speed (measured: 0.35, 0.38, 0.93 at 0.1, 0.3 and 1 degree).
constexpr double kLevel = 1e-4, kGentle = 0.0145, kOrder = 0.0063, kCreeping = 0.36;
/// Of a slope, as a tangent, that each layer beyond two holds, up to so many layers (measured: 0.85 of the speed of 8
/// layers at 1 degree, 0.85 of 10 at 1.2, 0.86 of 14 at 1.5, 0.84 of 16 and 0.78 of 20 at 2, 0.86 of 28 at 4), and the
/// share of a film's speed from which on it is not told.
constexpr double kLayerHolds = 0.0004, kMostLayers = 22, kHeldLittle = 0.9;
/// Speeds along a wall in spacings per second: of a filtered liquid that slides, of a thick one that flows at all.
constexpr double kSlides = 1, kCreeps = 0.02;
/// nu t/H2 from which on a wall would have slowed a layer of thickness H by some 15 %.
constexpr double kDragged = 0.04;
/// Cosine between the normals of walls that face each other; spacings of the narrowest gap that is looked at, and the
/// share of its layers by which it may seem not to be full.
constexpr double kOpposite = -0.999, kLeastGap = 3.5, kFilled = 0.2;
/// Share of the speed through a gap from which on its layers pass each other (measured beside flows: 0.70 at 0.70 of
/// Poiseuille's in 12 layers, 0.58 at 0.59 in 8, 0.64 at 0.75 in 4; 0.9 to 1.4 at 0.91 to 1.12).
constexpr double kPassing = 0.75;
constexpr double kCalmed = 0.2;  ///< share of what calming would do to shear in the midst of a liquid
/// Of the speed that a film of so many layers should have on a slope, a tangent: what the order of its particles
/// leaves.
double heldShare(double slope, double layers) {
  if (slope <= kLevel) return 1;
  const double order = slope < kGentle ? std::sqrt(std::max(0.0, 1 - kOrder * kOrder / (slope * slope))) : 1;
  const double depth = 1 - kLayerHolds * std::max(0.0, std::min(layers, kMostLayers) - 2) / slope;
  return std::max(kCreeping, std::min(order, depth));
}

}  // namespace

/// By material, then by wall: of the filter, and of the implicit stage.
std::vector<ViscosityStage::AtWall> ViscosityStage::atWalls(const ParticleStore& store) const {
  std::vector<AtWall> found(2 * m_held.size() * m_materials.size());
  if (found.empty()) return found;
  const float spacing = static_cast<float>(m_settings.spacing);
  for (size_t i = 0; i < store.size(); ++i) {
    if (!isLiquid(store, i)) continue;
    const size_t stage = m_implicit.active() && i < m_viscous.size() && m_viscous[i] > 0 ? 1 : 0;
    AtWall* wall = &found[2 * m_held.size() * store.material()[i]] + stage;
    for (const WallSurface& held : m_held) {
      const WallPlane plane = held.at(store.position()[i]);
      const float height = plane.heightOf(store.position()[i]);
      ++wall->all;
      wall->near += height < kNearLayers * spacing ? 1 : 0;
      const Vector3 velocity = vectorOf(store.velocity()[i]), normal{plane.x, plane.y, plane.z};
      if (height < spacing) {
        addTouching(store, i, velocity, normal, *wall);
      } else if (height < 2 * spacing) {
        ++wall->above;
        wall->speedAbove += (velocity - velocity.dot(normal) * normal).norm();
      }
      wall += 2;
    }
  }
  return found;
}

/// Of what the implicit stage solves beside fixed particles, by material; walls have their own. Once per frame, while
/// the lists are those of the particles.
void ViscosityStage::measureBeds(const ParticleStore& store, const PairLists& lists, std::span<const uint32_t> fluid) {
  const size_t kinds = m_materials.size();
  m_bedParts.assign(chunkCount(fluid.size(), grain::kPairs) * kinds, AtWall{});
  const double reach = kTouching * m_settings.spacing;
  forChunks(fluid.size(), grain::kPairs, [&](size_t first, size_t last) {
    AtWall* beds = &m_bedParts[first / grain::kPairs * kinds];
    for (const uint32_t i : fluid.subspan(first, last - first)) {
      if (!isLiquid(store, i) || m_viscous[i] == 0) continue;
      AtWall& bed = beds[store.material()[i]];
      ++bed.all, ++bed.near;
      Vector3 away, drift;
      double count = 0;
      for (uint32_t q = lists.begin[i]; q < lists.last[i]; ++q) {
        const uint32_t j = lists.index[q];
        if (store.motion()[j] != api::Motion::Static) continue;
        const Vector3 line = vectorOf(store.separation(i, j));
        if (line.squaredNorm() > reach * reach) continue;
        away += line, drift += vectorOf(store.velocity()[j]), ++count;
      }
      if (!(count > 0) || !(away.norm() > 0)) continue;
      const Vector3 normal = away.normalized(), velocity = vectorOf(store.velocity()[i]) - drift / count;
      addTouching(store, i, velocity, normal, bed);
      const Vector3 place = vectorOf(store.position()[i]);
      bed.places += place, bed.squares += place * place.transpose();
    }
  });
  m_beds.assign(kinds, AtWall{});
  for (size_t k = 0; k < m_bedParts.size(); ++k) {
    AtWall& bed = m_beds[k % kinds];
    const AtWall& part = m_bedParts[k];
    bed.all += part.all, bed.near += part.near, bed.touching += part.touching;
    bed.speed += part.speed, bed.viscosity += part.viscosity, bed.nu += part.nu, bed.normal += part.normal;
    bed.places += part.places, bed.squares += part.squares;
  }
}

/// A particle of the first layer at a wall or on fixed matter, which passes it at so much.
void ViscosityStage::addTouching(const ParticleStore& store, size_t i, const Vector3& velocity, const Vector3& normal,
                                 AtWall& at) const {
  const double viscosity = viscosityOf(store, i);
  ++at.touching;
  at.speed += (velocity - velocity.dot(normal) * normal).norm();
  at.viscosity += viscosity;
  at.nu += viscosity * double{store.position()[i].w} / double{store.mass()[i]};
  at.normal += normal;
}

/// Gives a bed the normal of the plane through its first layer; false where that is none, as in a channel or a vessel.
/// What lies in order leans on its neighbours all at the same angle, so that theirs would be no normal of the bed.
bool ViscosityStage::flatten(AtWall& bed) const {
  if (bed.touching < 3) return false;
  const auto count = static_cast<double>(bed.touching);
  const Vector3 mean = bed.places / count;
  const Eigen::SelfAdjointEigenSolver<Matrix3> axes(bed.squares / count - mean * mean.transpose());
  if (axes.eigenvalues()[0] > kFlat * kFlat * m_settings.spacing * m_settings.spacing) return false;
  const Vector3 normal = axes.eigenvectors().col(0);
  bed.normal = bed.normal.dot(normal) > 0 ? normal : Vector3(-normal);
  return true;
}

/// What the implicit stage's film on a wall, or on a bed of fixed particles, shows otherwise than it is.
template <class Tell>
void ViscosityStage::filmLimits(const AtWall& film, double few, double faster, const Tell& tell) const {
  const double spacing = m_settings.spacing;
  if (!(film.speed > kCreeps * spacing * static_cast<double>(film.touching))) return;
  const auto touching = static_cast<double>(film.touching);
  const double viscosity = film.viscosity / touching, layers = static_cast<double>(film.near) / touching;
  if (layers < few && static_cast<double>(film.all) < double{kNearLayers} * touching)
    tell(viscosity, 1 / (1 + faster / layers), "the film is few particles thick",
         useOf("solver/particle_spacing", 0.5 * spacing));
  const Vector3 gravity = vectorOf(m_settings.gravity), normal = film.normal.normalized();
  const double press = -gravity.dot(normal), slope = press > 0 ? (gravity + press * normal).norm() / press : 0;
  const double share = heldShare(slope, static_cast<double>(film.all) / touching);
  if (share < kHeldLittle) tell(viscosity, 1 / share, "on so gentle a slope the order of particles holds it", "");
}

/// Share of its speed with which a liquid flows through the gap between two walls that it fills, and whose layers find
/// no room to pass each other; 1 where they do, or where it does not fill one. What sticks to a wall flows three times
/// as fast at 1 1/2 spacings as at a half, a little less in a narrow gap: what hardly does moves as one.
double ViscosityStage::gapShare(size_t one, size_t other, std::span<const AtWall> atWalls) const {
  if (m_held[one].isCurved() || m_held[other].isCurved()) return 1;  // no gap is everywhere as wide
  const WallPlane &a = m_held[one].plane, &b = m_held[other].plane;
  if (a.x * b.x + a.y * b.y + a.z * b.z > kOpposite) return 1;
  const AtWall &near = atWalls[2 * one + 1], &far = atWalls[2 * other + 1];
  const auto first = static_cast<double>(near.touching + far.touching);
  const auto second = static_cast<double>(near.above + far.above);
  const double speed = near.speed + far.speed;
  if (near.touching == 0 || far.touching == 0 || second == 0 || !(speed > kCreeps * m_settings.spacing * first))
    return 1;
  const double layers = -(double{a.offset} + double{b.offset}) / m_settings.spacing;
  if (layers < kLeastGap || std::abs(static_cast<double>(near.all) / (first / 2) - layers) > kFilled * layers) return 1;
  const double passes = (near.speedAbove + far.speedAbove) / second / (speed / first);
  return passes / (3 * (layers - 1.5) / (layers - 0.5));
}

/// What walls do to a material's liquid and particles cannot show: the greatest of it.
void ViscosityStage::wallLimits(size_t material, double time, std::span<const AtWall> atWalls,
                                std::vector<Limit>& out) const {
  const double spacing = m_settings.spacing;
  const double calmed = calming() * filterReach();
  Limit limit{std::string(m_materials[material].id()) + ".viscosity", 1, 1, "Pa·s"};
  const auto tell = [&](double asked, double share, const char* why, const std::string& use) {
    if (std::abs(std::log(share)) <= std::abs(std::log(limit.delivered / limit.asked))) return;
    limit.asked = asked;
    limit.delivered = share * asked;
    limit.why = why;
    limit.use = use;
  };
  const auto flows = [&](const AtWall& at, double spacings) {
    return at.touching > 0 && at.speed > spacings * spacing * static_cast<double>(at.touching);
  };
  for (size_t w = 0; w < m_held.size(); ++w) {
    const AtWall &filtered = atWalls[2 * w], &solved = atWalls[2 * w + 1];
    if (flows(filtered, kSlides)) {
      const auto touching = static_cast<double>(filtered.touching);
      const double thick = spacing * static_cast<double>(filtered.all) / touching;
      if (filtered.nu / touching * time > kDragged * thick * thick)
        tell(filtered.viscosity / touching, 0, "walls hold it, which the velocity filter does not know",
             "solver/viscosity_model=implicit");
    }
    filmLimits(solved, kFewLayers, kThin, tell);
    if (!flows(solved, kCreeps)) continue;
    const auto touching = static_cast<double>(solved.touching);
    const double viscosity = solved.viscosity / touching;
    if (const double nu = solved.nu / touching; nu < calmed)
      tell(viscosity, 1 + kCalmed * calmed / nu, "calming resists more", "solver/xsph_minimum=0");
  }
  const bool flowsEvenly = m_mushy[material] == 0 && !m_yields;  // what yields moves as one where it does not
  for (size_t w = 0; w < m_held.size() && flowsEvenly; ++w) {
    for (size_t v = w + 1; v < m_held.size(); ++v) {
      const double share = gapShare(w, v, atWalls);
      const AtWall& at = atWalls[2 * w + 1];
      if (share < kPassing)
        tell(at.viscosity / static_cast<double>(at.touching), 1 / share,
             "its layers have no room to pass each other in the gap that it fills", "");
    }
  }
  if (material < m_beds.size()) {
    AtWall bed = m_beds[material];
    if (flatten(bed)) filmLimits(bed, kFewOnBed, kThinOnBed, tell);
  }
  if (!limit.why.empty()) out.push_back(std::move(limit));
}

void ViscosityStage::limits(const ParticleStore& store, double time, std::vector<Limit>& out) const {
  struct Asked {
    double viscosity = 0, density = 1, yieldStress = 0;  // Pa s, kg/m3, Pa
  };
  std::vector<Asked> asked(m_materials.size());
  for (size_t i = 0; i < store.size(); ++i) {
    if (!isLiquid(store, i)) continue;
    Asked& most = asked[store.material()[i]];
    const double viscosity = viscosityOf(store, i);
    most.yieldStress = std::max(most.yieldStress, m_materials[store.material()[i]].yieldStress(store.temperature()[i]));
    if (viscosity <= most.viscosity) continue;
    most.viscosity = viscosity;
    most.density = double{store.mass()[i]} / double{store.position()[i].w};
  }
  const std::vector<AtWall> walls = atWalls(store);
  const bool filterAlone = m_settings.viscosityModel == ViscosityModel::Xsph;
  const double reach = filterAlone ? filterReach() : m_implicit.greatestViscosity();
  for (size_t m = 0; m < asked.size(); ++m) {
    const double delivered = reach * asked[m].density;
    const std::string id = m_materials[m].id();
    if (asked[m].viscosity > delivered)
      out.push_back({id + ".viscosity", asked[m].viscosity, delivered, "Pa·s"});
    else if (asked[m].viscosity > 0)
      wallLimits(m, time, std::span(walls).subspan(2 * m_held.size() * m, 2 * m_held.size()), out);
    if (filterAlone && asked[m].yieldStress > 0) out.push_back({id + ".yield_stress", asked[m].yieldStress, 0, "Pa"});
  }
  if (m_implicit.residual() > m_settings.viscosityTolerance)
    out.push_back({"solver.viscosity_tolerance", m_settings.viscosityTolerance, m_implicit.residual(), ""});
}

}  // namespace ps
