// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"
#include "core/solver/bodyheat.h"
#include "core/solver/heatsource.h"
#include "core/solver/report.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ps {

/// Heat that comes up inside bodies, in W of thermal time: the power of each body, spread evenly over the mass of those
/// of its particles that are there now, held ones and vapour among them. Matter of no body, as emitters pour it, has no
/// power. Fixed particles may be a bath that keeps its temperature, or insulate; what was of them and moves does
/// neither.
class BodyHeating {
 public:
  /// By the index of the body that particles carry; those beyond the list have none.
  void set(std::span<const BodyHeat> bodies);
  bool holds() const { return m_holds; }          ///< some body is held at a temperature
  bool insulates() const { return m_insulates; }  ///< some body is insulated
  bool convects() const { return m_convects; }    ///< some body has a fluid behind its surface
  /// K at which a particle is held; 0 for one that warms and cools.
  double heldAt(const ParticleStore& store, size_t i) const { return isFixed(store, i) ? of(store, i).held : 0; }
  /// W/(m2 K) of that fluid; 0 for a particle of no such body.
  double convectionAt(const ParticleStore& store, size_t i) const {
    return isFixed(store, i) && of(store, i).held > 0 ? of(store, i).convection : 0;
  }
  bool isInsulated(const ParticleStore& store, size_t i) const { return isFixed(store, i) && of(store, i).insulated; }
  bool fluxes() const { return m_fluxes; }  ///< some body gives heat by its surface
  /// W/m2 that a particle's body gives by its surface; 0 for a particle of none.
  double fluxAt(const ParticleStore& store, size_t i) const { return isFixed(store, i) ? of(store, i).flux : 0; }
  size_t count() const { return m_bodies.size(); }
  const BodyHeat& of(uint32_t body) const { return m_bodies[body]; }
  /// Makes ready for a frame: adds up the mass of heated bodies in the order of the store.
  void measure(const ParticleStore& store);
  /// Adds W to particles [first, last).
  void addTo(const ParticleStore& store, size_t first, size_t last, std::span<double> watts) const;

 private:
  bool isFixed(const ParticleStore& store, size_t i) const {
    return store.motion()[i] == api::Motion::Static && store.body()[i] < m_bodies.size();
  }
  const BodyHeat& of(const ParticleStore& store, size_t i) const { return m_bodies[store.body()[i]]; }

  std::vector<BodyHeat> m_bodies;
  std::vector<double> m_perMass;  ///< W/kg by body; empty when nothing is heated
  bool m_holds = false, m_insulates = false, m_convects = false, m_fluxes = false;
};

/// Heat that plugins put into matter or take from it, in W of thermal time. One that throws, or answers with what is no
/// finite number, is put aside for good.
class PluginHeating {
 public:
  /// Makes the plugins' fields, so that they are there before the first frame.
  void set(std::vector<HeatSource> sources, ParticleStore& store);
  /// Adds W to all particles.
  void addTo(ParticleStore& store, const api::ParticleView& view, const api::ThermalContext& where,
             std::span<double> watts);
  /// Ids of all that have been put aside; putAside() adds to them.
  const std::vector<std::string>& aside() const { return m_aside; }
  void putAside(const std::vector<std::string>& names);
  /// Those put aside since the last call.
  std::vector<PluginFault> drainFaults() { return std::exchange(m_faults, {}); }

 private:
  bool isAside(const HeatSource& source) const;
  template <class Call>
  bool guarded(const HeatSource& source, Call&& call);
  static void declareFields(const HeatSource& source, ParticleStore& store);
  void ask(const HeatSource& source, ParticleStore& store, const api::ParticleView& view, api::ThermalContext where);

  std::vector<HeatSource> m_sources;
  std::vector<std::string> m_aside;
  std::vector<PluginFault> m_faults;
  std::vector<double> m_watts;  ///< of one source
};

}  // namespace ps
