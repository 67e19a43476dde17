// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/detail.h"

#include <iterator>

namespace ps::vr {
namespace {

constexpr int kWindow = 120, kMany = 96;  // frames looked at, and how many of them must be late
constexpr int kCalm = 450;                // frames without haste, after which it may be finer
constexpr double kHaste = 0.5;            // of a frame's time

}  // namespace

void Detail::note(double cost, double period) {
  ++m_frames;
  if (cost > period) ++m_late;
  m_quick = cost < kHaste * period ? m_quick + 1 : 0;
  if (m_late >= kMany && m_step + 1 < std::size(kSteps)) {
    ++m_step;
    m_frames = m_late = m_quick = 0;
  } else if (m_quick >= kCalm && m_step > 0) {
    --m_step;
    m_frames = m_late = m_quick = 0;
  } else if (m_frames >= kWindow) {
    m_frames = m_late = 0;
  }
}

}  // namespace ps::vr
