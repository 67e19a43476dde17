// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/phasestage.h"

#include "core/base/parallel.h"
#include "core/math/thesis.h"
#include "core/solver/contact/handover.h"

#include <algorithm>
#include <functional>

namespace ps {
namespace {

using api::Motion;
using api::Phase;

constexpr double kVolumeStep = 0.05;      ///< largest change of a rest volume in one frame
constexpr double kMeltScatter = 0.3;      ///< half width of the melt threshold around melt_break_fraction
constexpr double kVapourThreshold = 0.5;  ///< gas fraction at which a particle begins to move as vapour
constexpr double kMistThreshold = 0.9;    ///< gas fraction from which vapour with a little mist in it counts as gas
constexpr double kDropThreshold = 0.4;    ///< and below which it falls again as a drop

/// A number in [-1, 1) from a particle's id: the same for life, whatever its index (finaliser of MurmurHash3).
double scatter(uint32_t id) {
  uint32_t h = id * 0x9e3779b1u + 0x85ebca6bu;
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  h ^= h >> 16;
  return static_cast<double>(h) / 2147483648.0 - 1;
}

/// Least share of the liquid's density in the thesis's model: its table's 700 kg/m³ of water vapour. The curve ends at
/// 0.0025, at which a parcel would be wider than its neighbours' reach.
constexpr double kThinnestThesis = 0.7;

Phase phaseOf(double solid, double liquid, double gas) {
  if (gas >= kMistThreshold) return Phase::Gas;
  if (gas > 0) return Phase::Boiling;
  if (solid >= 1) return Phase::Solid;
  return solid > 0 && liquid > 0 ? Phase::Melting : Phase::Liquid;
}

}  // namespace

/// Of one particle after another: those side by side are often of one matter and equally warm.
class PhaseStage::Density {
 public:
  double of(const PhaseStage& stage, const ParticleStore& store, size_t i) {
    const State state{store.material()[i], store.temperature()[i], store.solidFraction()[i], store.liquidFraction()[i],
                      store.gasFraction()[i]};
    if (state == m_state) return m_density;
    m_state = state;
    return m_density = stage.restDensity(store, i);
  }

 private:
  struct State {
    uint32_t material = 0;
    double temperature = -1;  // K: no particle has it
    float solid = 0, liquid = 0, gas = 0;
    bool operator==(const State&) const = default;
  };
  State m_state;
  double m_density = 0;
};

void setShares(ParticleStore& store, size_t i, Phase phase) {
  const bool plateau = phase == Phase::Melting || phase == Phase::Boiling;
  const float whole = plateau ? 0.5f : 1;
  store.solidFraction()[i] = phase == Phase::Solid || phase == Phase::Melting ? whole : 0;
  store.liquidFraction()[i] = plateau || phase == Phase::Liquid ? whole : 0;
  store.gasFraction()[i] = phase == Phase::Boiling || phase == Phase::Gas ? whole : 0;
}

void PhaseStage::configure(const SolverSettings& solver, std::span<const BakedMaterial> materials) {
  m_solver = solver;
  m_materials = materials;
  m_rules.clear();
  for (const BakedMaterial& material : materials) {
    m_rules.push_back({material.scalar(propertyIndex("melt_break_fraction")),
                       material.scalar(propertyIndex("freeze_bond_fraction"))});
  }
}

double PhaseStage::meltThreshold(uint32_t material, uint32_t id) const {
  const Rule& rule = m_rules[material];
  // Above 1 - freeze, so that no particle breaks and bonds in turn.
  const double lowest = std::max(0.02, 1 - rule.freeze + 0.02);
  return std::clamp(rule.meltBreak + kMeltScatter * scatter(id), lowest, 0.98);
}

double PhaseStage::restDensity(const ParticleStore& store, size_t i) const {
  const BakedMaterial& material = m_materials[store.material()[i]];
  const double t = store.temperature()[i], solid = store.solidFraction()[i], gas = store.gasFraction()[i];
  if (m_solver.gasModel == GasModel::Thesis && gas > 0) {
    return material.condensedDensity(t, solid) * std::max(thesisDensityScale(gas), kThinnestThesis);
  }
  return material.restDensity(t, solid, store.liquidFraction()[i], gas);
}

double PhaseStage::targetVolume(const ParticleStore& store, size_t i) const {
  return double{store.mass()[i]} / restDensity(store, i);
}

void PhaseStage::initialise(ParticleStore& store, size_t first, size_t last, bool bound) {
  for (size_t i = first; i < last; ++i) {
    const double s = store.solidFraction()[i], l = store.liquidFraction()[i], g = store.gasFraction()[i];
    store.position()[i].w = static_cast<float>(targetVolume(store, i));
    store.phase()[i] = phaseOf(s, l, g);
    Motion& motion = store.motion()[i];
    if (motion != Motion::Static) {
      const bool holds = s >= 0.5 || (bound && s > 0 && 1 - s < meltThreshold(store.material()[i], store.id()[i]));
      motion = g >= kVapourThreshold ? Motion::Gas : holds ? Motion::Solid : Motion::Liquid;
    }
    const float mass = store.mass()[i];
    store.velocity()[i].w = motion == Motion::Static || !(mass > 0) ? 0.0f : 1.0f / mass;
  }
}

Motion PhaseStage::nextMotion(const ParticleStore& store, size_t i) const {
  const uint32_t material = store.material()[i];
  const double solid = store.solidFraction()[i], gas = store.gasFraction()[i];
  const Motion motion = store.motion()[i];
  const bool vapour = gas >= (motion == Motion::Gas ? kDropThreshold : kVapourThreshold);
  const bool sublimes = m_materials[material].caloric().sublimes != 0;
  if (motion == Motion::Solid) {
    if (1 - solid < meltThreshold(material, store.id()[i])) return Motion::Solid;
    return vapour || sublimes ? Motion::Gas : Motion::Liquid;
  }
  if (solid >= m_rules[material].freeze) return Motion::Solid;
  return vapour || (sublimes && motion == Motion::Gas) ? Motion::Gas : Motion::Liquid;
}

bool PhaseStage::update(ParticleStore& store, std::vector<uint32_t>& melted) {
  m_turns.resize(store.size());
  const auto body = [&](size_t first, size_t last) {
    Density density;
    for (size_t i = first; i < last; ++i) {
      m_turns[i] = Turn::None;
      store.phase()[i] = phaseOf(store.solidFraction()[i], store.liquidFraction()[i], store.gasFraction()[i]);
      Motion& motion = store.motion()[i];
      if (motion == Motion::Static) continue;
      const double volume = store.position()[i].w, target = double{store.mass()[i]} / density.of(*this, store, i);
      const double step = kVolumeStep * volume;
      store.position()[i].w = static_cast<float>(volume + std::clamp(target - volume, -step, step));
      const Motion next = nextMotion(store, i);
      if ((motion == Motion::Solid) != (next == Motion::Solid)) {
        m_turns[i] = next == Motion::Solid ? Turn::Froze : Turn::Melted;
        if (next == Motion::Solid) store.compression()[i] = handover::kUnknownOverlap;
      }
      motion = next;
    }
  };
  forChunks(store.size(), grain::kParticles, body);
  findIndices(m_turns.size(), melted, [&](size_t i) { return m_turns[i] == Turn::Melted; });
  return anyChunk(m_turns.size(), grain::kNumbers, [&](size_t first, size_t last) {
    bool froze = false;
    for (size_t i = first; i < last; ++i) froze = froze || m_turns[i] == Turn::Froze;
    return froze;
  });
}

}  // namespace ps
