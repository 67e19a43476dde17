// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/probetable.h"

#include "core/base/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ps {
namespace {

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
  std::vector<std::string> titles{"time_s", "thermal_time_s"}, ours;
  for (const char* phase : {"solid", "melting", "liquid", "boiling", "gas"}) {
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

std::vector<double> columnValues(const FrameStats& stats) {
  std::vector<double> values{stats.time, stats.thermalTime};
  values.insert(values.end(), stats.probes.begin(), stats.probes.end());
  for (const PhaseAmount& phase : stats.phases) values.push_back(phase.mass);
  values.push_back(stats.temperatureMean);
  return values;
}

ProbeTable::ProbeTable(const std::string& path, const std::vector<std::string>& probeNames) : m_file(path) {
  std::string row;
  for (const std::string& title : columnTitles(probeNames)) row += (row.empty() ? "" : ",") + quoted(title);
  writeRow(row);
}

void ProbeTable::add(const FrameStats& stats) {
  std::string row;
  const char* separator = "";
  for (const double value : columnValues(stats)) {
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
