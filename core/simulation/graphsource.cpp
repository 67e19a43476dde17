// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/graphsource.h"

#include "core/scene/shownname.h"
#include "core/scene/track.h"
#include "core/simulation/declared.h"
#include "core/simulation/parametercourse.h"
#include "core/simulation/tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

constexpr std::string_view kProbe = "probe/", kFrame = "frame/";
constexpr size_t kMostGraphs = 3, kMostSeries = 5;

double massOf(const FrameStats& stats, api::Phase phase) { return stats.phases[static_cast<size_t>(phase)].mass; }

/// Temperatures of no matter are none.
double degrees(double kelvin) { return kelvin > 0 ? kelvin : std::numeric_limits<double>::quiet_NaN(); }

/// Whether a probe follows what the mass by phase shows.
bool isPhaseMass(const std::string& quantity) { return quantity.ends_with("_mass"); }

bool isMeanOfAll(const Probe& probe) {
  return probe.quantity == "temperature" && probe.body.empty() && probe.phase.empty() && probe.material.empty() &&
         !probe.region && !probe.wave && !probe.fixed;
}

bool measuresSame(Probe a, const Probe& b) {
  a.name = b.name;
  return a == b;
}

/// What people call whose parameter it is; "" where there is one owner.
std::string ownerNameIn(const Project& project, const Address& address) {
  const auto named = [&](const auto& items) {
    for (const auto& item : items) {
      if (item.id == address.id) return shownName(item);
    }
    return address.id;
  };
  switch (address.owner) {
    case Owner::Wall:
      return named(project.environment.walls);
    case Owner::Body:
    case Owner::Constraint:
    case Owner::Shape:
      return named(project.bodies);
    case Owner::Emitter:
      return named(project.emitters);
    case Owner::Sink:
      return named(project.sinks);
    case Owner::Material:
      for (const SceneMaterial& material : project.materials) {
        if (material.id == address.id && !material.label.empty()) return material.label;
      }
      return address.id;
    default:
      return {};
  }
}

class Chooser {
 public:
  std::vector<Graph> graphs;

  void add(Graph::Kind kind, std::vector<std::string> series) {
    Graph graph;
    graph.id = "graph-" + std::to_string(graphs.size() + 1);
    graph.kind = kind;
    graph.series = std::move(series);
    graphs.push_back(std::move(graph));
  }

  void addHeat(const Project& project, const ParticleFields& fields) {
    std::vector<std::string> series{frameSource("temperature")};
    for (const Probe& probe : project.probes) {
      if (series.size() < kMostSeries && fields.unitOf(probe.quantity) == "K" && !isMeanOfAll(probe))
        series.push_back(probeSource(probe.id));
    }
    add(Graph::Kind::Time, std::move(series));
    add(Graph::Kind::Phases, {});
  }

  void addByUnit(const Probe& probe, const std::string& unit) {
    const auto same = std::find(m_units.begin(), m_units.end(), unit);
    if (same == m_units.end() && graphs.size() == kMostGraphs) return;
    if (same == m_units.end()) {
      m_units.resize(graphs.size());  // of those before: none that is asked for
      m_units.push_back(unit);
      add(Graph::Kind::Time, {probeSource(probe.id)});
      return;
    }
    std::vector<std::string>& series = graphs[static_cast<size_t>(same - m_units.begin())].series;
    if (series.size() < kMostSeries) series.push_back(probeSource(probe.id));
  }

 private:
  std::vector<std::string> m_units;  ///< by graph
};

}  // namespace

const std::vector<FrameQuantity>& frameQuantities() {
  using Stats = const FrameStats&;
  using api::Phase;
  static const std::vector<FrameQuantity> all{
      {"temperature", "Mean temperature", "K", [](Stats s) { return degrees(s.temperatureMean); }},
      {"temperature_min", "Lowest temperature", "K", [](Stats s) { return degrees(s.temperatureMin); }},
      {"temperature_max", "Highest temperature", "K", [](Stats s) { return degrees(s.temperatureMax); }},
      {"thermal_energy", "Thermal energy", "J", [](Stats s) { return s.thermalEnergy; }},
      {"kinetic_energy", "Kinetic energy", "J", [](Stats s) { return s.kineticEnergy; }},
      {"heat_walls", "Heat through walls", "J", [](Stats s) { return s.heat.walls; }},
      {"heat_air", "Heat through air", "J", [](Stats s) { return s.heat.air; }},
      {"heat_radiation", "Heat by radiation", "J", [](Stats s) { return s.heat.radiation; }},
      {"heat_heaters", "Heat by heaters", "J", [](Stats s) { return s.heat.heaters; }},
      {"heat_matter", "Heat with matter", "J", [](Stats s) { return s.heat.sources; }},
      {"solid_mass", "Solid mass", "kg", [](Stats s) { return massOf(s, Phase::Solid); }},
      {"melting_mass", "Melting mass", "kg", [](Stats s) { return massOf(s, Phase::Melting); }},
      {"liquid_mass", "Liquid mass", "kg", [](Stats s) { return massOf(s, Phase::Liquid); }},
      {"boiling_mass", "Boiling mass", "kg", [](Stats s) { return massOf(s, Phase::Boiling); }},
      {"gas_mass", "Gas mass", "kg", [](Stats s) { return massOf(s, Phase::Gas); }},
      {"poured_mass", "Mass from taps", "kg", [](Stats s) { return s.flow.poured.mass; }},
      {"drained_mass", "Mass into drains", "kg", [](Stats s) { return s.flow.drained.mass; }},
      {"density_error", "Mean density error", "1", [](Stats s) { return s.densityErrorMean; }},
      {"density_error_max", "Highest density error", "1", [](Stats s) { return s.densityErrorMax; }},
      {"computing_time", "Computing time of a frame", "s", [](Stats s) { return s.totalMilliseconds / 1000; }},
  };
  return all;
}

std::string probeSource(std::string_view probe) { return std::string(kProbe).append(probe); }
std::string frameSource(std::string_view quantity) { return std::string(kFrame).append(quantity); }

std::string parameterSource(const Address& parameter) { return std::string(kParameterSource) + parameter.text(); }

bool canBePlotted(const api::ParameterDeclaration& declaration) {
  using api::ParameterKind;
  return declaration.kind == ParameterKind::Number || declaration.kind == ParameterKind::Integer ||
         declaration.kind == ParameterKind::Toggle;
}

std::string probeOfSource(std::string_view source) {
  return source.starts_with(kProbe) ? std::string(source.substr(kProbe.size())) : std::string();
}

GraphSource::GraphSource(const std::string& source, const Project& project, const ParticleFields& fields,
                         const PluginRegistry* plugins) {
  if (source.starts_with(kParameterSource)) {
    if (const auto address = Address::parse(source.substr(kParameterSource.size()))) adopt(*address, project, plugins);
    return;
  }
  const std::string id = probeOfSource(source);
  const auto probe = std::find_if(project.probes.begin(), project.probes.end(),
                                  [&](const Probe& p) { return !id.empty() && p.id == id; });
  if (probe != project.probes.end()) {
    m_known = true;
    m_probe = *probe;
    m_label = shownName(*probe);
    m_unit = fields.unitOf(probe->quantity);
    return;
  }
  const auto frame = std::find_if(frameQuantities().begin(), frameQuantities().end(),
                                  [&](const FrameQuantity& q) { return frameSource(q.key) == source; });
  if (frame == frameQuantities().end()) return;
  m_known = true;
  m_frame = &*frame;
  m_label = frame->label;
  m_unit = frame->unit;
}

void GraphSource::adopt(const Address& parameter, const Project& project, const PluginRegistry* plugins) {
  const api::ParameterDeclaration* declared = declarationOf(project, plugins, parameter);
  if (!declared || parameter.owner == Owner::Probe || !hasOwner(project, parameter) || !canBePlotted(*declared)) return;
  m_known = true;
  m_parameter = parameter;
  m_unit = declared->unit && *declared->unit ? declared->unit : "1";
  m_label = declared->label;
  const std::string owner = ownerNameIn(project, parameter);
  if (!owner.empty()) m_label = owner + ": " + m_label;
}

bool GraphSource::operator==(const GraphSource& other) const {
  return m_label == other.m_label && m_frame == other.m_frame && m_probe == other.m_probe &&
         m_parameter == other.m_parameter;
}

double GraphSource::operator()(const FrameStats& stats) const {
  if (m_frame) return m_frame->of(stats);
  if (m_parameter) return m_course ? m_course->at(stats) : std::numeric_limits<double>::quiet_NaN();
  if (!m_probe || !stats.measured) return std::numeric_limits<double>::quiet_NaN();
  if (stats.measured != m_measured) {
    m_measured = stats.measured;
    const auto found = std::find_if(m_measured->begin(), m_measured->end(),
                                    [&](const Probe& probe) { return measuresSame(probe, *m_probe); });
    m_place = static_cast<size_t>(found - m_measured->begin());
  }
  return m_place < stats.probes.size() ? stats.probes[m_place] : std::numeric_limits<double>::quiet_NaN();
}

std::vector<Graph> graphsFor(const Project& project, const ParticleFields& fields) {
  if (project.graphs) return *project.graphs;
  Chooser chosen;
  const bool heat =
      project.probes.empty() || std::any_of(project.probes.begin(), project.probes.end(), [&](const Probe& probe) {
        return fields.unitOf(probe.quantity) == "K" || isPhaseMass(probe.quantity);
      });
  if (heat) chosen.addHeat(project, fields);
  for (const Probe& probe : project.probes) {
    const std::string unit = fields.unitOf(probe.quantity);
    if (unit.empty() || unit == "K" || (heat && isPhaseMass(probe.quantity))) continue;
    chosen.addByUnit(probe, unit);
  }
  return chosen.graphs;
}

}  // namespace ps
