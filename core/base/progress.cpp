// SPDX-License-Identifier: Apache-2.0
#include "core/base/progress.h"

namespace ps {

void Progress::begin(const char* stage, double weight, double steps) {
  m_before = m_before + m_weight;
  m_done = 0;
  m_weight = weight;
  m_steps = steps;
  m_stage = stage;
}

void Progress::advance(size_t steps) {
  m_done += steps;
  advanced(steps);
  if (m_cancelled) throw Cancelled();
}

Progress::State Progress::state() const {
  const double whole = m_whole, steps = m_steps;
  const double share = steps > 0 ? std::min(1.0, static_cast<double>(m_done) / steps) : 0;
  const double done = whole > 0 ? (m_before + m_weight * share) / whole : 0;
  return {m_stage, std::clamp(done, 0.0, 1.0)};
}

}  // namespace ps
