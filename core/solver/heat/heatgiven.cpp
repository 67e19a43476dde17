// SPDX-License-Identifier: Apache-2.0
// The part of HeatStage by which a hand gives heat and takes it back, between two frames.
#include "core/base/parallel.h"
#include "core/solver/heat/heat.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace ps {
namespace {

constexpr int kMostRounds = 64;
constexpr double kNothing = 1e-9;  // J: less than this is no way towards the coldest

}  // namespace

bool HeatStage::give(ParticleStore& store, std::span<double> joules) {
  std::vector<double> left(joules.begin(), joules.end());
  std::fill(joules.begin(), joules.end(), 0.0);
  if (!works() || store.size() == 0) return false;
  const bool done = guarded([&] {
    if (!isUpToDate()) bringUpToDate(store);
    for (int round = 0; round < kMostRounds; ++round) {
      const bool more = giveRound(store, left);
      for (size_t i = 0; i < joules.size(); ++i) joules[i] += m_joules[i];
      if (!more) break;
    }
  });
  if (!done) return false;
  for (const double given : joules) {
    m_ledger.heaters += given;
    m_ledger.exchanged += std::abs(given);
  }
  energy(store);  // what changes of materials and models go by
  return works();
}

/// All that is to come, and of what is to be taken as much as can surely be had now: m_joules. Takes it off `left`, and
/// says whether another round would do more.
bool HeatStage::giveRound(ParticleStore& store, std::span<double> left) {
  m_joules.assign(left.begin(), left.end());
  bool more = false;
  for (size_t i = 0; i < left.size(); ++i) {
    if (left[i] < 0) m_joules[i] = std::max(left[i], -std::max(0.0, aboveColdest(store, i)));
    left[i] -= m_joules[i];
    more = more || (left[i] < 0 && m_joules[i] < -kNothing);
  }
  const api::ThermalContext where = context();
  const api::ParticleView view = store.view();
  const auto body = [&](size_t first, size_t last) {
    const CalleeScope callee(m_modelName.c_str());
    m_model->addHeat(where, view, first, last, m_joules.data(), 0);
    deriveRange(store, first, last);
  };
  forChunks(store.size(), grain::kNeighbours, body);
  return more;
}

}  // namespace ps
