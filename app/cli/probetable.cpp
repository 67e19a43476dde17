// SPDX-License-Identifier: Apache-2.0
#include "app/cli/probetable.h"

#include "core/base/error.h"

#include <charconv>
#include <cmath>

namespace ps::cli {
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

ProbeTable::ProbeTable(const std::string& path, const std::vector<std::string>& probeNames)
    : m_path(path), m_file(path, std::ios::binary | std::ios::trunc) {
  if (!m_file) throw Error(path + ": cannot be written; choose another folder");
  m_file << "time_s,thermal_time_s";
  for (const std::string& name : probeNames) m_file << ',' << quoted(name);
  for (const char* phase : {"solid", "melting", "liquid", "boiling", "gas"}) m_file << ',' << phase << ".mass[kg]";
  m_file << ",all.temperature[K]\n";
}

void ProbeTable::add(const FrameStats& stats) {
  m_file << cell(stats.time) << ',' << cell(stats.thermalTime);
  for (const double value : stats.probes) m_file << ',' << cell(value);
  for (const PhaseAmount& phase : stats.phases) m_file << ',' << cell(phase.mass);
  m_file << ',' << cell(stats.temperatureMean) << '\n';
}

void ProbeTable::finish() {
  m_file.close();
  if (m_file.fail()) throw Error(m_path + ": could not be written to its end; the disk is full");
}

}  // namespace ps::cli
