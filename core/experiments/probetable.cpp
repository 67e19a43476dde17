// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/probetable.h"

#include "core/base/error.h"
#include "core/simulation/particlefield.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ps {
namespace {

constexpr const char* kHeatTitles[] = {"heat.energy[J]",    "heat.walls[J]",   "heat.air[J]",
                                       "heat.radiation[J]", "heat.heaters[J]", "heat.sources[J]",
                                       "heat.exchanged[J]", "heat.open[J]",    "heat.open_share[1]"};

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string cell(double value) {
  if (!std::isfinite(value)) return "";
  char buffer[40];
  return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace

std::vector<std::string> columnTitles(const std::vector<std::string>& probeNames) {
  std::vector<std::string> titles{"time_s", "thermal_time_s"}, ours(std::begin(kHeatTitles), std::end(kHeatTitles));
  for (const char* phase : kPhaseNames) {
    ours.push_back(std::string(phase) + ".mass[kg]");
  }
  ours.emplace_back("all.temperature[K]");
  const auto isTaken = [&](const std::string& title) {
    return std::find(titles.begin(), titles.end(), title) != titles.end() ||
           std::find(ours.begin(), ours.end(), title) != ours.end();
  };
  for (const std::string& name : probeNames) {
    std::string title = name;
    for (int k = 2; isTaken(title); ++k) title = name + " (" + std::to_string(k) + ")";
    titles.push_back(title);
  }
  titles.insert(titles.end(), ours.begin(), ours.end());
  return titles;
}

ProbeColumns::ProbeColumns(const Engine& engine) : m_titles(columnTitles(engine.probeNames())) {
  const FrameStats start = engine.stats();
  m_heat = start.heat;
  m_thermalEnergy = start.thermalEnergy;
}

std::vector<double> ProbeColumns::values(const Engine& engine, const FrameStats& stats) const {
  std::vector<double> values{stats.time, stats.thermalTime};
  values.insert(values.end(), stats.probes.begin(), stats.probes.end());
  double sum = 0;
  for (const double energy : engine.solver().thermalEnergies()) sum += std::abs(energy);
  const HeatLedger& heat = stats.heat;
  const double open = stats.thermalEnergy - m_thermalEnergy - (heat.net() - m_heat.net());
  values.insert(values.end(),
                {stats.thermalEnergy, heat.walls - m_heat.walls, heat.air - m_heat.air,
                 heat.radiation - m_heat.radiation, heat.heaters - m_heat.heaters, heat.sources - m_heat.sources,
                 heat.exchanged - m_heat.exchanged, open, sum > 0 ? std::abs(open) / sum : 0.0});
  for (const PhaseAmount& phase : stats.phases) values.push_back(phase.mass);
  values.push_back(stats.temperatureMean);
  return values;
}

ProbeTable::ProbeTable(const std::string& path, const Engine& engine) : m_file(path), m_columns(engine) {
  std::string row;
  for (const std::string& title : m_columns.titles()) row += (row.empty() ? "" : ",") + quoted(title);
  writeRow(row);
  add(engine, engine.stats());
}

void ProbeTable::add(const Engine& engine, const FrameStats& stats) {
  std::string row;
  const char* separator = "";
  for (const double value : m_columns.values(engine, stats)) {
    row += separator + cell(value);
    separator = ",";
  }
  writeRow(row);
}

void ProbeTable::finish() { m_file.finish(); }

/// At once, so that a full disk ends the run and not its last frame.
void ProbeTable::writeRow(const std::string& row) {
  m_file.write(row + '\n');
  m_file.flush();
}

}  // namespace ps
