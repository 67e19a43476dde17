// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/engine.h"

#include <nlohmann/json.hpp>

#include <vector>

namespace ps {

/// Whether matter has come to rest: what moves in the second half of a run, and how far it has crept since the first.
class SettlingMeasure {
 public:
  /// `frames` of the whole run.
  explicit SettlingMeasure(long frames) : m_half(frames / 2) {}
  void add(Engine& engine, const FrameStats& stats);
  /// Kinetic energy in J (`highest` of the whole run, `mean` of the second half, `end`), the mean and the highest rms
  /// speed of the second half in m/s, and in m how far bodies (their centre of mass) and solid particles have moved in
  /// it, the farthest of each. Matter that came or went meanwhile is left out. null for a run that ended before.
  nlohmann::json json(Engine& engine) const;

 private:
  struct Place {
    bool here = false;
    api::Float4 position{};
  };
  long m_half, m_frames = 0;
  double m_start = 0;  ///< s
  double m_highest = 0, m_sum = 0, m_end = 0, m_speedSum = 0, m_speedHighest = 0;
  std::vector<Place> m_places;  ///< by particle id, at half time
};

}  // namespace ps
