// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/runreport.h"

#include "core/base/hash.h"
#include "core/base/parallel.h"
#include "core/simulation/particlefield.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ps {
namespace {

nlohmann::json jsonOf(const Spread& spread) {
  return {{"mean", spread.mean}, {"median", spread.median}, {"p95", spread.p95}};
}

nlohmann::json jsonOf(const FlowAmount& amount) {
  return {{"count", amount.count}, {"mass", amount.mass}, {"energy", amount.energy}};
}
nlohmann::json jsonOf(const api::Double3& v) { return {v.x, v.y, v.z}; }

api::Double3 sumOf(const api::Double3& a, const api::Double3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

double liquidCount(const FrameStats& stats) {
  return static_cast<double>(stats.phases[static_cast<size_t>(api::Phase::Liquid)].count +
                             stats.phases[static_cast<size_t>(api::Phase::Boiling)].count);
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<size_t>(std::ceil(share * static_cast<double>(values.size()))) - 1];
  };
  return {mean, at(0.5), at(0.95)};
}

void RunReport::add(const StepReport& step, const FrameStats& stats) {
  if (step.flags && !m_flags) m_message = step.message;
  m_flags |= step.flags;
  m_total.push_back(step.totalMilliseconds);
  m_totalSerial.push_back(step.totalSerialMilliseconds);
  for (size_t s = 0; s < m_stages.size(); ++s) {
    m_stages[s].push_back(step.milliseconds[s]);
    m_stagesSerial[s].push_back(step.serialMilliseconds[s]);
  }
  const double liquid = liquidCount(stats);
  m_errorSum += liquid * step.densityErrorMean;
  m_liquid += liquid;
  m_errorMax = std::max(m_errorMax, step.densityErrorMax);
  if (frames() == 1) m_momentum.start = step.momentum.start;
  m_momentum.end = step.momentum.end;
  m_momentum.external = sumOf(m_momentum.external, step.momentum.external);
  if (step.mechanical.measured) add(step.mechanical);
  m_last = stats;
}

void RunReport::add(const MechanicalRecord& frame) {
  MechanicalRecord& all = m_mechanical;
  if (!all.measured) {
    all = frame;
    return;
  }
  m_between += (frame.kineticStart + frame.potentialStart) - (all.kineticEnd + all.potentialEnd);
  all.kineticEnd = frame.kineticEnd;
  all.potentialEnd = frame.potentialEnd;
  for (size_t part = 0; part < all.given.size(); ++part) all.given[part] += frame.given[part];
  all.angularEnd = frame.angularEnd;
  all.angularExternal = sumOf(all.angularExternal, frame.angularExternal);
}

void RunReport::add(const std::vector<PluginFault>& late) {
  for (const PluginFault& fault : late) {
    if (!m_flags) m_message = "plugin '" + fault.plugin + "': " + fault.what;
    m_flags |= static_cast<StepFlags>(StepFlag::PluginFault);
  }
}

/// J of what moves; who gave it since the start adds up to end less start.
nlohmann::json RunReport::mechanicalJson() const {
  const MechanicalRecord& m = m_mechanical;
  nlohmann::json given{{"between_frames", m_between}};
  for (size_t part = 0; part < m.given.size(); ++part)
    given[partName(static_cast<MechanicalRecord::Part>(part))] = m.given[part];
  return {{"start", m.kineticStart + m.potentialStart},
          {"end", m.kineticEnd + m.potentialEnd},
          {"kinetic", {{"start", m.kineticStart}, {"end", m.kineticEnd}}},
          {"weight", {{"start", m.potentialStart}, {"end", m.potentialEnd}}},
          {"given", given}};
}

nlohmann::json RunReport::json(Engine& engine, double wallSeconds) const {
  const ParameterSet& set = engine.project().solver.parameters;
  const auto number = [&](const char* key) { return numberOf(set, solverParameters(), key); };
  nlohmann::json milliseconds{{"total", jsonOf(total())}};
  for (size_t s = 0; s < m_stages.size(); ++s) milliseconds[stageName(static_cast<Stage>(s))] = jsonOf(stage(s));
  nlohmann::json limits = nlohmann::json::array();
  for (const Limit& limit : engine.limits()) {
    limits.push_back(
        {{"what", limit.what}, {"asked", limit.asked}, {"delivered", limit.delivered}, {"unit", limit.unit}});
    if (limit.kelvin && limit.kelvin->front() > 0) limits.back()["above"] = limit.kelvin->front();
    if (limit.kelvin && std::isfinite(limit.kelvin->back())) limits.back()["below"] = limit.kelvin->back();
    if (!limit.why.empty()) limits.back()["why"] = limit.why;
    if (!limit.use.empty()) limits.back()["use"] = limit.use;
    if (limit.body >= 0) limits.back()["body"] = engine.bodyIds()[static_cast<size_t>(limit.body)];
  }
  nlohmann::json phases;
  for (size_t p = 0; p < kPhaseNames.size(); ++p) {
    phases[kPhaseNames[p]] = {{"count", m_last.phases[p].count}, {"mass", m_last.phases[p].mass}};
  }
  nlohmann::json momentum{
      {"start", jsonOf(m_momentum.start)}, {"end", jsonOf(m_momentum.end)}, {"external", jsonOf(m_momentum.external)}};
  nlohmann::json energy{{"start", m_start.thermalEnergy},
                        {"end", m_last.thermalEnergy},
                        {"walls", m_last.heat.walls},
                        {"air", m_last.heat.air},
                        {"radiation", m_last.heat.radiation},
                        {"heaters", m_last.heat.heaters},
                        {"sources", m_last.heat.sources},
                        {"air_warming", m_last.heat.airWarming},
                        {"exchanged", m_last.heat.exchanged},
                        {"elastic", engine.solver().elasticEnergy()},
                        {"drift", m_last.thermalEnergy - m_start.thermalEnergy - m_last.heat.net()}};
  if (m_mechanical.measured) {
    energy["mechanical"] = mechanicalJson();
    momentum["angular"] = {{"start", jsonOf(m_mechanical.angularStart)},
                           {"end", jsonOf(m_mechanical.angularEnd)},
                           {"external", jsonOf(m_mechanical.angularExternal)}};
  }
  return {{"particles", engine.particles().size()},
          {"frames", frames()},
          {"substeps", static_cast<int>(number("substeps"))},
          {"iterations", static_cast<int>(number("iterations"))},
          {"dt", number("dt")},
          {"simulated_s", m_last.time - m_start.time},
          {"wall_s", wallSeconds},
          {"threads", threadCount()},
          {"backend", "cpu"},
          {"isa", instructionSet()},
          {"state_hash", hashText(engine.stateHash())},
          {"flags", flagNames(m_flags)},
          {"limits", limits},
          {"ms_per_frame", milliseconds},
          {"density_error", {{"mean", meanDensityError()}, {"max", maxDensityError()}}},
          {"energy", energy},
          {"flow",
           {{"poured", jsonOf(m_last.flow.poured)},
            {"drained", jsonOf(m_last.flow.drained)},
            {"held", jsonOf(m_last.flow.held)}}},
          {"momentum", momentum},
          {"phases", phases},
          {"temperature",
           {{"min", m_last.temperatureMin}, {"mean", m_last.temperatureMean}, {"max", m_last.temperatureMax}}}};
}

}  // namespace ps
