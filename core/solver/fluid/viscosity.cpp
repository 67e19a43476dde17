// SPDX-License-Identifier: Apache-2.0
#include "core/solver/fluid/viscosity.h"

#include "core/base/parallelarrays.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr size_t kSpare = 16;
/// Time in s within which a wall that drags along a layer of a spacing is seen to do so: the filter knows no walls. The
/// shorter one where there is none that liquid sticks to.
constexpr double kWallTime = 8, kNoWallTime = 1;
/// Substep in s to which calming refers, that of the defaults.
constexpr double kCalmingTime = 1.0 / 240;
constexpr float kImplicit = -2;  ///< marks a coefficient, until gatherThick() has seen it
/// Share of solid at which crystals touch and mush stops to flow.
constexpr double kPackedFraction = 0.6;
/// Shear rate at which matter below its yield stress may creep, 1/s: thin enough for the iteration, and a slope that
/// should rest takes a quarter of an hour to lean over.
constexpr float kCreep = 1e-3f;

/// int W x^2 dV = 4 pi/3 int W r^4 dr, by Simpson's rule.
double secondMoment(const Kernel& kernel) {
  constexpr int kSteps = 200;
  const double step = kernel.supportRadius() / kSteps;
  const auto integrand = [&](double r) { return kernel.value(r) * r * r * r * r; };
  double sum = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double r = k * step;
    sum += step / 6 * (integrand(r) + 4 * integrand(r + 0.5 * step) + integrand(r + step));
  }
  return 4 * std::numbers::pi / 3 * sum;
}

/// What the viscosity of a liquid depends on.
struct LiquidState {
  uint32_t material = 0;
  double temperature = -1;  // K: no particle has it
  float solid = 0;
  bool operator==(const LiquidState&) const = default;
};

}  // namespace

void ViscosityStage::configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                               std::span<const BakedMaterial> materials, const FixedShapes& shapes) {
  m_settings = settings;
  m_materials = materials;
  m_secondMoment = secondMoment(Kernel(settings.kernel, settings.spacing * settings.supportRatio));
  m_implicit.configure(settings, walls, shapes);
  m_held.clear();
  for (const Wall& wall : walls) {
    if (wall.noSlip) m_held.emplace_back(wall);
  }
  m_mushy.clear();
  for (const BakedMaterial& material : materials) {
    const api::Caloric& c = material.caloric();
    m_mushy.push_back(c.melts != 0 && c.solidus < c.liquidus ? 1 : 0);
  }
}

double ViscosityStage::filterReach() const { return m_secondMoment * m_settings.substeps / (2 * m_settings.dt); }

double ViscosityStage::calming() const {
  const double substep = m_settings.dt / m_settings.substeps;
  return std::clamp(m_settings.xsphMinimum, 0.0, 1.0) * std::min(1.0, substep / kCalmingTime);
}

double ViscosityStage::filterSuffices() const {
  return std::min(filterReach(), m_settings.spacing * m_settings.spacing / (m_held.empty() ? kNoWallTime : kWallTime));
}

double ViscosityStage::viscosityOf(const ParticleStore& store, size_t i) const {
  const uint32_t material = store.material()[i];
  const double liquid = m_materials[material].viscosity(store.temperature()[i]), solid = store.solidFraction()[i];
  if (m_mushy[material] == 0 || !(solid > 0)) return liquid;
  const double room = 1 - solid / kPackedFraction;
  const double most = std::max(liquid, m_settings.viscosityMax);
  return room > 0 ? std::min(most, liquid / (room * std::sqrt(room))) : most;
}

void ViscosityStage::refresh(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density) {
  const size_t n = store.size();
  assignAll(m_coefficient, n + kSpare, -1.0f);  // the dummy counts as no fluid
  const double reach = filterReach(), suffices = filterSuffices();
  const ViscosityModel model = m_settings.viscosityModel;
  const float least = static_cast<float>(calming());
  const std::span<const uint32_t> fluid = density.fluid();
  std::atomic<bool> thick = false, filters = false, yields = false;
  forChunks(fluid.size(), grain::kParticles, [&](size_t first, size_t last) {
    LiquidState former;
    double viscosity = 0;
    bool yield = false, anyThick = false, anyFilters = false, anyYields = false;
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = fluid[k];
      float c = least;
      if (isLiquid(store, i)) {
        const double density0 = double{store.mass()[i]} / double{store.position()[i].w};
        const LiquidState state{store.material()[i], store.temperature()[i], store.solidFraction()[i]};
        if (state != former) {  // those side by side are often of one matter and equally warm
          viscosity = viscosityOf(store, i);
          yield = m_materials[state.material].yieldStress(state.temperature) > 0;
          former = state;
        }
        const double nu = viscosity / density0;
        c = std::clamp(static_cast<float>(nu / reach), least, 1.0f);
        if (model == ViscosityModel::Implicit || (model == ViscosityModel::Automatic && (nu > suffices || yield))) {
          // Calmed only where its own viscosity is less than calming gives.
          m_coefficient[i] = kImplicit - (nu < double{least} * reach ? least : 0);
          anyThick = true;
          anyYields = anyYields || yield;
          continue;
        }
      }
      anyFilters = anyFilters || c > 0;
      m_coefficient[i] = c;
    }
    if (anyThick) thick = true;
    if (anyFilters) filters = true;
    if (anyYields) yields = true;
  });
  m_filters = filters;
  m_yields = yields;
  m_beds.clear();
  m_common = -1;
  if (!thick) {
    const float one = fluid.empty() ? -1 : m_coefficient[fluid.front()];
    const bool others = anyChunk(fluid.size(), grain::kNumbers, [&](size_t first, size_t last) {
      bool other = false;
      for (const uint32_t i : fluid.subspan(first, last - first)) other = other || m_coefficient[i] != one;
      return other;
    });
    if (!others) m_common = one;
    m_implicit.deactivate();
    return;
  }
  gatherThick(store, density);
  m_implicit.refresh(store, m_viscous);
  if (density.touchesFixed()) measureBeds(store, density.lists(store, neighbours), density.fluid());
  if (m_yields) m_implicit.shearRates(store, neighbours, density, m_shearRate);
}

/// For the implicit stage: who, with which viscosity; particles marked by refresh() get their XSPH coefficient.
void ViscosityStage::gatherThick(const ParticleStore& store, const DensityStage& density) {
  const size_t n = store.size();
  assignAll(m_viscosity, n + kSpare, -1.0f);
  assignAll(m_viscous, n + kSpare, 0.0f);
  m_yieldStress.assign(m_yields ? n : 0, 0.0f);
  m_shearRate.assign(m_yields ? n + kSpare : 0, 0.0f);
  const double reach = m_implicit.greatestViscosity();
  std::atomic<bool> filters = m_filters;
  const std::span<const uint32_t> fluid = density.fluid();
  forChunks(fluid.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = fluid[k];
      if (!isLiquid(store, i)) continue;
      const double most = reach * double{store.mass()[i]} / double{store.position()[i].w};
      m_viscosity[i] = static_cast<float>(std::min(most, viscosityOf(store, i)));
      if (m_coefficient[i] >= 0) continue;
      m_coefficient[i] = kImplicit - m_coefficient[i];
      if (m_coefficient[i] > 0) filters = true;
      m_viscous[i] = 1;
      if (m_yields) {
        m_yieldStress[i] = static_cast<float>(m_materials[store.material()[i]].yieldStress(store.temperature()[i]));
      }
    }
  });
  m_filters = filters;
  m_plastic = m_viscosity;
}

/// mu_p + tau_y/(gamma_dot + epsilon), within reach.
void ViscosityStage::addYieldStress(const ParticleStore& store) {
  const float reach = static_cast<float>(m_implicit.greatestViscosity());
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      if (m_yieldStress[i] <= 0) continue;
      const float most = reach * store.mass()[i] / store.position()[i].w;
      m_viscosity[i] = std::min(most, m_plastic[i] + m_yieldStress[i] / (m_shearRate[i] + kCreep));
    }
  });
}

void ViscosityStage::filter(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density) {
  const std::span<const uint32_t> fluid = density.fluid(), wet = density.wetSolids();
  assignBoth(m_which, fluid, wet);
  m_change.resize(m_which.size());
  const PairLists near = density.nearLists(store, neighbours);
  const float scale = static_cast<float>(density.kernelScale());
  forChunks(m_which.size(), grain::kPairs, [&](size_t first, size_t last) {
    const size_t fluids = m_common >= 0 ? std::clamp(fluid.size(), first, last) : first;
    sumViscosity(near, store.position(), store.velocity(), m_common, m_which.data(), first, fluids, m_change.data());
    sumViscosity(near, store.position(), store.velocity(), m_coefficient.data(), m_which.data(), fluids, last,
                 m_change.data());
  });
  tellFixed(store, density.lists(store, neighbours), density.watchedFixed());
  api::Float4* velocity = store.velocity();
  forChunks(m_which.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      api::Float4& v = velocity[m_which[k]];
      v.x += scale * m_change[k].x;
      v.y += scale * m_change[k].y;
      v.z += scale * m_change[k].z;
    }
  });
}

/// What fixed particles get of the filter, pair by pair as sumViscosity() has it, before it changes velocities.
void ViscosityStage::tellFixed(const ParticleStore& store, const PairLists& pairs,
                               std::span<const uint32_t> fixed) const {
  if (fixed.empty()) return;
  const Kernel kernel(m_settings.kernel, m_settings.spacing * m_settings.supportRatio);
  m_reactions->start(chunkCount(fixed.size(), grain::kNeighbours));
  forChunks(fixed.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const uint32_t j = fixed[k];
      Vector3 impulse;
      for (uint32_t q = pairs.begin[j]; q < pairs.last[j]; ++q) {
        const uint32_t i = pairs.index[q];
        if (!(m_coefficient[i] > 0) || store.velocity()[i].w == 0) continue;
        const double distance = vectorOf(store.separation(i, j)).norm();
        const double volumes = double{store.position()[i].w} + double{store.position()[j].w};
        impulse += double{store.mass()[i]} * double{m_coefficient[i]} * volumes * kernel.value(distance) *
                   (vectorOf(store.velocity()[i]) - vectorOf(store.velocity()[j]));
      }
      m_reactions->add(first / grain::kNeighbours, m_reactions->ofBody(store.body()[j]), vectorOf(store.position()[j]),
                       impulse);
    }
  });
  m_reactions->finish();
}

/// Of all that viscosity moves, kg m/s.
Vector3 ViscosityStage::momentumOf(const ParticleStore& store, const DensityStage& density) {
  Vector3 sum;
  for (const std::span<const uint32_t> list : {density.fluid(), density.wetSolids()}) {
    sum += sumOfChunks(m_partial, list.size(), grain::kNumbers, [&](size_t first, size_t last) {
      Vector3 part;
      for (const uint32_t i : list.subspan(first, last - first))
        part += double{store.mass()[i]} * vectorOf(store.velocity()[i]);
      return part;
    });
  }
  return sum;
}

void ViscosityStage::apply(ParticleStore& store, const Neighbours& neighbours, const DensityStage& density) {
  if (density.fluid().empty() || m_coefficient.size() < store.size()) return;
  if (m_filters) {
    const Vector3 before = density.touchesFixed() ? momentumOf(store, density) : Vector3{};
    filter(store, neighbours, density);
    if (density.touchesFixed()) m_externalImpulse.add(momentumOf(store, density) - before);
  }
  if (!m_implicit.active()) return;
  if (m_yields) addYieldStress(store);
  const Vector3 before = momentumOf(store, density);
  m_implicit.apply(store, neighbours, density, m_viscosity.data());
  if (m_implicit.held()) m_externalImpulse.add(momentumOf(store, density) - before);
  if (m_yields) m_implicit.shearRates(store, neighbours, density, m_shearRate);
}

}  // namespace ps
