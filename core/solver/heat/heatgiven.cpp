// SPDX-License-Identifier: Apache-2.0
// The part of HeatStage by which a hand gives heat and takes it back, between two frames.
#include "core/base/parallelarrays.h"
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
  Gift gift;
  for (size_t i = 0; i < joules.size(); ++i) {
    if (joules[i] == 0) continue;
    gift.rows.push_back(static_cast<uint32_t>(i));
    gift.left.push_back(joules[i]);
    const uint32_t chunk = static_cast<uint32_t>(i / grain::kNeighbours);
    if (gift.chunks.empty() || gift.chunks.back() != chunk) gift.chunks.push_back(chunk);
    joules[i] = 0;
  }
  if (!works() || store.size() == 0) return false;
  const bool done = guarded([&] {
    if (!isUpToDate()) bringUpToDate(store);
    assignAll(m_joules, store.size(), 0.0);
    for (int round = 0; round < kMostRounds; ++round) {
      const bool more = giveRound(store, gift);
      for (const uint32_t i : gift.rows) joules[i] += m_joules[i];
      if (!more) break;
    }
  });
  if (!done) return false;
  for (const uint32_t i : gift.rows) {
    m_ledger.heaters += joules[i];
    m_ledger.exchanged += std::abs(joules[i]);
  }
  energy(store);  // what changes of materials and models go by
  return works();
}

/// All that is to come, and of what is to be taken as much as can surely be had now: m_joules. Takes it off what is
/// left, and says whether another round would do more.
bool HeatStage::giveRound(ParticleStore& store, Gift& gift) {
  bool more = false;
  for (size_t k = 0; k < gift.rows.size(); ++k) {
    const uint32_t i = gift.rows[k];
    double& left = gift.left[k];
    m_joules[i] = left < 0 ? std::max(left, -std::max(0.0, aboveColdest(store, i))) : left;
    left -= m_joules[i];
    more = more || (left < 0 && m_joules[i] < -kNothing);
  }
  const api::ThermalContext where = context();
  const api::ParticleView view = store.view();
  // A hand reaches few of them.
  forChunks(gift.chunks.size(), 1, [&](size_t chunk, size_t) {
    const size_t first = gift.chunks[chunk] * grain::kNeighbours;
    const size_t last = std::min(store.size(), first + grain::kNeighbours);
    const CalleeScope callee(m_modelName.c_str());
    m_model->addHeat(where, view, first, last, m_joules.data(), 0);
    deriveRange(store, first, last);
  });
  return more;
}

}  // namespace ps
