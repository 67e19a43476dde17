// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/outputfile.h"
#include "core/simulation/snapshot.h"

#include <string>
#include <vector>

namespace ps {

/// Titles of the columns: time_s, thermal_time_s, the project's probes as name.quantity[unit], the mass in each phase
/// and the mean temperature of all matter. No two are alike: a probe whose title is taken gets " (2)" after it.
std::vector<std::string> columnTitles(const std::vector<std::string>& probeNames);
/// One frame's values under them; NaN where a probe saw no particle.
std::vector<double> columnValues(const FrameStats& stats);

/// What graphs show, as CSV (RFC 4180, decimal points): one row per frame; an empty cell where a probe saw no particle.
class ProbeTable {
 public:
  /// Throws Error when the file cannot be written; an older one of that name stands until finish().
  ProbeTable(const std::string& path, const std::vector<std::string>& probeNames);
  /// Throws Error when the disk is full.
  void add(const FrameStats& stats);
  void finish();
  /// Of a run that failed: leaves the rows until now in a file of their own and says which, see OutputFile.
  std::string keepPart() { return m_file.keepPart(); }

 private:
  void writeRow(const std::string& row);
  OutputFile m_file;
};

}  // namespace ps
