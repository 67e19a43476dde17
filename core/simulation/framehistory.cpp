// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/framehistory.h"

#include <algorithm>

namespace ps {

void FrameHistory::clear() {
  m_frames.clear();
  m_stride = 1;
}

void FrameHistory::add(const FrameStats& stats) {
  if (!m_frames.empty() && m_frames.back().frame == stats.frame) m_frames.pop_back();
  if (m_frames.size() == kMost) thin();
  m_frames.push_back(stats);
}

void FrameHistory::cutAfter(uint64_t frame) {
  while (!m_frames.empty() && m_frames.back().frame > frame) m_frames.pop_back();
}

void FrameHistory::thin() {
  // What was among the newest the last time may be as coarse as the rest already is.
  while (m_frames.size() > (kMost + kNewest) / 2) {
    const auto end = m_frames.end() - kNewest;
    m_frames.erase(
        std::remove_if(m_frames.begin(), end, [this](const FrameStats& s) { return s.frame % m_stride != 0; }), end);
    if (m_frames.size() > (kMost + kNewest) / 2) m_stride *= 2;
  }
}

std::vector<FrameStats> FrameHistory::since(uint64_t frame, size_t most) const {
  const auto first = std::lower_bound(m_frames.begin(), m_frames.end(), frame,
                                      [](const FrameStats& stats, uint64_t number) { return stats.frame < number; });
  const auto count = std::min(most, static_cast<size_t>(m_frames.end() - first));
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace ps
