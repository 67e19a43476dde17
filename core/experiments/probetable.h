// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/outputfile.h"
#include "core/simulation/engine.h"
#include "core/simulation/snapshot.h"

#include <string>
#include <vector>

namespace ps {

/// Titles of the columns: time_s, thermal_time_s, the project's probes as name.quantity[unit], the heat balance, the
/// mass in each phase and the mean temperature of all matter. No two are alike: a probe whose title is taken gets "
/// (2)" after it.
std::vector<std::string> columnTitles(const std::vector<std::string>& probeNames);

/// The columns of a run, which begins as the engine stands when they are made.
///
/// The heat balance is heat.energy, thermal energy of all matter in J; since the run began what came in by walls, air,
/// radiation, heaters and with matter, and the sum of its amounts (heat.exchanged); heat.open, what of the change of
/// energy none of these explains, and heat.open_share, that over the sum of |m h|.
class ProbeColumns {
 public:
  explicit ProbeColumns(const Engine& engine);
  const std::vector<std::string>& titles() const { return m_titles; }
  /// One frame's; NaN where a probe saw no particle. `stats` are the engine's, of now.
  std::vector<double> values(const Engine& engine, const FrameStats& stats) const;

 private:
  std::vector<std::string> m_titles;
  HeatLedger m_heat;
  double m_thermalEnergy;  ///< J, both as the run began
};

/// What graphs show, as CSV (RFC 4180, decimal points): a row for how the run begins and one per frame; an empty cell
/// where a probe saw no particle, or measures what only a frame has, as forces.
class ProbeTable {
 public:
  /// Throws Error when the file cannot be written; an older one of that name stands until finish().
  ProbeTable(const std::string& path, const Engine& engine);
  /// Throws Error when the disk is full.
  void add(const Engine& engine, const FrameStats& stats);
  void finish();
  /// Of a run that failed: leaves the rows until now in a file of their own and says which, see OutputFile.
  std::string keepPart() { return m_file.keepPart(); }

 private:
  void writeRow(const std::string& row);
  OutputFile m_file;
  ProbeColumns m_columns;
};

}  // namespace ps
