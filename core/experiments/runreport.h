// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/engine.h"

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <vector>

namespace ps {

/// Mean, median and 95th percentile.
struct Spread {
  double mean = 0, median = 0, p95 = 0;
};
Spread spreadOf(std::vector<double> values);

/// Collects a run's frames and writes what --report holds.
class RunReport {
 public:
  /// `start`: statistics before the first frame.
  explicit RunReport(const FrameStats& start) : m_start(start), m_last(start) {}
  void add(const StepReport& step, const FrameStats& stats);
  /// Plugins that threw after the last frame.
  void add(const std::vector<PluginFault>& late);

  StepFlags flags() const { return m_flags; }
  const std::string& message() const { return m_message; }  ///< of the first flag
  size_t frames() const { return m_total.size(); }
  Spread total() const { return spreadOf(m_total); }
  Spread stage(size_t index) const { return spreadOf(m_stages[index]); }
  /// What one thread did alone (StepReport::serialMilliseconds).
  Spread totalSerial() const { return spreadOf(m_totalSerial); }
  Spread stageSerial(size_t index) const { return spreadOf(m_stagesSerial[index]); }
  /// Over liquid particles and frames.
  double meanDensityError() const { return m_liquid > 0 ? m_errorSum / m_liquid : 0; }
  double maxDensityError() const { return m_errorMax; }
  nlohmann::json json(Engine& engine, double wallSeconds) const;

 private:
  FrameStats m_start, m_last;
  StepFlags m_flags = 0;
  std::string m_message;
  std::vector<double> m_total, m_totalSerial;
  std::array<std::vector<double>, static_cast<size_t>(Stage::Count)> m_stages, m_stagesSerial;
  void add(const MechanicalRecord& frame);
  nlohmann::json mechanicalJson() const;

  MomentumRecord m_momentum;      ///< start of the first frame, end of the last, impulse of all
  MechanicalRecord m_mechanical;  ///< likewise
  double m_between = 0;           ///< J, which came and went with matter, or with another gravity, between frames
  double m_errorSum = 0, m_errorMax = 0, m_liquid = 0;
};

}  // namespace ps
