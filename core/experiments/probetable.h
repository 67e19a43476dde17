// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"

#include <fstream>
#include <string>
#include <vector>

namespace ps {

/// Titles of the columns: time_s, thermal_time_s, the project's probes as name.quantity[unit], the mass in each phase
/// and the mean temperature of all matter.
std::vector<std::string> columnTitles(const std::vector<std::string>& probeNames);
/// One frame's values under them; NaN where a probe saw no particle.
std::vector<double> columnValues(const FrameStats& stats);

/// What graphs show, as CSV (RFC 4180, decimal points): one row per frame; an empty cell where a probe saw no particle.
class ProbeTable {
 public:
  /// Throws Error when the file cannot be written.
  ProbeTable(const std::string& path, const std::vector<std::string>& probeNames);
  void add(const FrameStats& stats);
  /// Throws Error when the disk is full.
  void finish();

 private:
  std::string m_path;
  std::ofstream m_file;
};

}  // namespace ps
