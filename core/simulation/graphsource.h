// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/address.h"
#include "core/simulation/particlefield.h"
#include "core/simulation/snapshot.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// What the curves of a graph may be of: the probes of a project, what every frame tells of matter as a whole, and the
// parameters of the scene.
namespace ps {

class ParameterCourse;
class PluginRegistry;

/// Something that each frame tells, without a probe. Another one is a row in graphsource.cpp.
struct FrameQuantity {
  const char *key, *label, *unit;  ///< "temperature", "Mean temperature", SI
  double (*of)(const FrameStats& stats);
};
const std::vector<FrameQuantity>& frameQuantities();

/// Sources as Graph::series writes them.
std::string probeSource(std::string_view probe);
std::string frameSource(std::string_view quantity);
inline constexpr std::string_view kParameterSource = "parameter/";
std::string parameterSource(const Address& parameter);
/// Whether the values of a parameter make a curve over time: those of a number or a switch.
bool canBePlotted(const api::ParameterDeclaration& declaration);
/// The probe's id behind "probe/", or "".
std::string probeOfSource(std::string_view source);

/// A source of a curve, looked up in a project.
class GraphSource {
 public:
  /// Without plugins the parameters that they declare are unknown.
  GraphSource(const std::string& source, const Project& project, const ParticleFields& fields,
              const PluginRegistry* plugins = nullptr);
  explicit operator bool() const { return m_known; }  ///< false: the project has none such
  const std::string& label() const { return m_label; }
  const std::string& unit() const { return m_unit; }  ///< SI; "1" for a pure number
  /// Whether the two are called alike and read the same off every frame.
  bool operator==(const GraphSource& other) const;
  /// Of which it is a parameter: a number or a switch, whose values no frame tells but the edits of its run.
  const std::optional<Address>& parameter() const { return m_parameter; }
  void setCourse(std::shared_ptr<const ParameterCourse> course) { m_course = std::move(course); }
  /// Of a frame; NaN where it measured none such. A probe that has been changed since measured something else then.
  double operator()(const FrameStats& stats) const;

 private:
  bool m_known = false;
  std::string m_label, m_unit;
  void adopt(const Address& parameter, const Project& project, const PluginRegistry* plugins);
  std::optional<Probe> m_probe;
  std::optional<Address> m_parameter;
  std::shared_ptr<const ParameterCourse> m_course;
  const FrameQuantity* m_frame = nullptr;
  mutable std::shared_ptr<const std::vector<Probe>> m_measured;  ///< in which m_place holds
  mutable size_t m_place = 0;
};

/// The graphs of a project: its own, or, where it says nothing, those that suit its probes. Of a scene whose probes
/// follow heat or phases, or that has none: temperatures and the mass in each phase; then one of each further unit,
/// three graphs at most.
std::vector<Graph> graphsFor(const Project& project, const ParticleFields& fields);

}  // namespace ps
