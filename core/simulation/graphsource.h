// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/particlefield.h"
#include "core/simulation/snapshot.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What the curves of a graph may be of: the probes of a project, and what every frame tells of matter as a whole.
namespace ps {

/// Something that each frame tells, without a probe. Another one is a row in graphsource.cpp.
struct FrameQuantity {
  const char *key, *label, *unit;  ///< "temperature", "Mean temperature", SI
  double (*of)(const FrameStats& stats);
};
const std::vector<FrameQuantity>& frameQuantities();

/// Sources as Graph::series writes them.
std::string probeSource(std::string_view probe);
std::string frameSource(std::string_view quantity);
/// The probe's id behind "probe/", or "".
std::string probeOfSource(std::string_view source);

/// A source of a curve, looked up in a project.
class GraphSource {
 public:
  GraphSource(const std::string& source, const Project& project, const ParticleFields& fields);
  explicit operator bool() const { return m_known; }  ///< false: the project has none such
  const std::string& label() const { return m_label; }
  const std::string& unit() const { return m_unit; }  ///< SI; "1" for a pure number
  /// Whether the two are called alike and read the same off every frame.
  bool operator==(const GraphSource& other) const;
  /// Of a frame; NaN where it measured none such. A probe that has been changed since measured something else then.
  double operator()(const FrameStats& stats) const;

 private:
  bool m_known = false;
  std::string m_label, m_unit;
  std::optional<Probe> m_probe;
  const FrameQuantity* m_frame = nullptr;
  mutable std::shared_ptr<const std::vector<Probe>> m_measured;  ///< in which m_place holds
  mutable size_t m_place = 0;
};

/// The graphs of a project: its own, or, where it says nothing, those that suit its probes. Of a scene whose probes
/// follow heat or phases, or that has none: temperatures and the mass in each phase; then one of each further unit,
/// three graphs at most.
std::vector<Graph> graphsFor(const Project& project, const ParticleFields& fields);

}  // namespace ps
