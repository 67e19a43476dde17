// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"
#include "core/solver/heatsource.h"
#include "core/solver/report.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ps {

/// Heat that comes up inside bodies, in W of thermal time: the power of each body, spread evenly over the mass of those
/// of its particles that are there now, held ones and vapour among them. Matter of no body, as emitters pour it, has no
/// power.
class BodyHeating {
 public:
  /// W by the index of the body that particles carry; those beyond the list have none.
  void set(std::span<const double> watts) { m_watts.assign(watts.begin(), watts.end()); }
  /// Makes ready for a frame: adds up the mass of heated bodies in the order of the store.
  void measure(const ParticleStore& store);
  /// Adds W to particles [first, last).
  void addTo(const ParticleStore& store, size_t first, size_t last, std::span<double> watts) const;

 private:
  std::vector<double> m_watts;    ///< W by body
  std::vector<double> m_perMass;  ///< W/kg by body; empty when nothing is heated
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
