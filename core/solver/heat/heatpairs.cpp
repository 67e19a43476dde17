// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/heatpairs.h"

#include "core/base/parallel.h"
#include "core/base/room.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace ps {
namespace {

/// Sum of V W below which a particle's surroundings count as cut off by a surface.
constexpr float kFullSupport = 0.95f;

}  // namespace

void HeatPairs::prepare(size_t count, size_t slots) {
  for (auto* list : {&begin, &same, &other, &end}) list->resize(count);
  for (auto* values : {&conductivity, &volume, &filled, &immersion, &m_inverseMoment}) values->resize(count + 1);
  sameTotal.resize(count);
  otherTotal.resize(count);
  makeRoomFor(partner, slots);
  for (auto* values : {&conductance, &m_square, &m_kernel}) makeRoomFor(*values, slots);
}

void HeatPairs::build(const ParticleStore& store, const api::NeighbourView& lists,
                      std::span<const BakedMaterial> materials, const Options& options) {
  m_options = options;
  const size_t n = store.size();
  if (n == 0) return;
  prepare(n, lists.slots);
  m_oneMaterial = materials.size() == 1;
  const auto matter = [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) {
      const BakedMaterial& material = materials[store.material()[i]];
      const double t = store.temperature()[i], s = store.solidFraction()[i];
      conductivity[i] =
          static_cast<float>(material.conductivity(t, s, store.liquidFraction()[i], store.gasFraction()[i]));
      volume[i] = static_cast<float>(static_cast<double>(store.mass()[i]) / material.condensedDensity(t, s));
    }
  };
  forChunks(n, grain::kNeighbours, matter);
  m_rooms.resize(std::max(m_rooms.size(), chunkCount(n, grain::kNeighbours)));
  const auto first = [&](size_t a, size_t b) { measure(store, lists, a, b); };
  forChunks(n, grain::kNeighbours, first);
  const auto second = [&](size_t a, size_t b) {
    conduct(a, b);
    if (m_options.contactConductance > 0) resist(store, a, b);
    if (!m_options.insulated.empty()) insulate(a, b);
  };
  forChunks(n, grain::kNeighbours, second);
}

float HeatPairs::condensedAround(const ParticleStore& store, size_t i) const {
  const double self = Kernel(m_options.kernel, m_options.support).value(0);
  double around = 0;
  const auto add = [&](uint32_t from, uint32_t to) {
    for (uint32_t k = from; k < to; ++k) {
      const uint32_t j = partner[k];
      if (store.motion()[j] != api::Motion::Gas) around += double{store.position()[j].w} * double{m_kernel[k]};
    }
  };
  add(begin[i], same[i]);
  add(other[i], end[i]);
  return static_cast<float>(std::min(1.0, around / std::max(0.2, 1 - double{store.position()[i].w} * self)));
}

/// Writes partners within the support and their squared distances: those of the particle's own material from the front
/// of its slots, others from the back.
HeatSlots HeatPairs::findPartners(const ParticleStore& store, const api::NeighbourView& lists, uint32_t i, Room& room) {
  const float limit = static_cast<float>(m_options.support * m_options.support), tiny = 1e-12f * limit;
  const uint32_t first = lists.begin[i], *list = lists.index + first;
  const size_t count = lists.last[i] - first;
  HeatSlots slots{first, first, lists.end[i], lists.end[i]};
  if (room.partner.size() < slots.end - first) {
    room.partner.resize(2 * (slots.end - first));
    room.square.resize(room.partner.size());
  }
  uint32_t* found = m_oneMaterial ? &partner[first] : room.partner.data();
  float* square = m_oneMaterial ? &m_square[first] : room.square.data();
  size_t used = 0;
  if (store.period().any()) {
    for (size_t k = 0; k < count; ++k) {
      const auto [x, y, z, unused] = store.separation(i, list[k]);
      const float r2 = std::max(x * x + y * y + z * z, tiny);
      if (r2 < limit) found[used] = list[k], square[used++] = r2;
    }
  } else {
    used = findHeatPartners(store.position(), i, list, count, limit, tiny, found, square);
  }
  if (m_oneMaterial) {
    slots.same = first + static_cast<uint32_t>(used);
    return slots;
  }
  const uint32_t *material = store.material(), own = material[i];
  for (size_t k = 0; k < used; ++k) {
    const uint32_t slot = material[found[k]] == own ? slots.same++ : --slots.other;
    partner[slot] = found[k];
    m_square[slot] = square[k];
  }
  return slots;
}

void HeatPairs::measure(const ParticleStore& store, const api::NeighbourView& lists, size_t first, size_t last) {
  const HeatKernel kernel(m_options.kernel, m_options.support);
  const float selfKernel = static_cast<float>(Kernel(m_options.kernel, m_options.support).value(0));
  Room& room = m_rooms[first / grain::kNeighbours];
  for (size_t i = first; i < last; ++i) {
    const HeatSlots slots = findPartners(store, lists, static_cast<uint32_t>(i), room);
    begin[i] = slots.begin, same[i] = slots.same, other[i] = slots.other, end[i] = slots.end;
    const HeatSums sums = sumHeatSlots(kernel, slots, partner.data(), volume.data(), m_square.data(), m_kernel.data(),
                                       conductance.data());
    const float full = volume[i] * selfKernel + sums.filled, m = std::clamp(sums.moment / 3, 0.8f, 1.25f);
    m_inverseMoment[i] = m_options.momentCorrection && full > kFullSupport ? 1 / m : 1.0f;
    filled[i] = full;
    immersion[i] = store.gasFraction()[i] > 0 ? condensedAround(store, i) : 0.0f;
  }
}

void HeatPairs::conduct(size_t first, size_t last) {
  for (size_t i = first; i < last; ++i) {
    const float vi = volume[i], mi = m_inverseMoment[i], ki = conductivity[i];
    // 2 V_i V_j (-F) times the mean of 1/M: every operation commutes in i and j.
    double total[2] = {0, 0};
    uint32_t k = begin[i];
    for (; k + 2 <= same[i]; k += 2) {
      for (uint32_t c = 0; c < 2; ++c) {
        const uint32_t j = partner[k + c];
        conductance[k + c] *= (vi * volume[j]) * (mi + m_inverseMoment[j]);
        total[c] += double{conductance[k + c]};
      }
    }
    if (k < same[i]) {
      const uint32_t j = partner[k];
      conductance[k] *= (vi * volume[j]) * (mi + m_inverseMoment[j]);
      total[0] += double{conductance[k]};
    }
    sameTotal[i] = total[0] + total[1];
    double others = 0;
    for (k = other[i]; k < end[i]; ++k) {
      const uint32_t j = partner[k];
      const float sum = ki + conductivity[j];
      const float harmonic = sum > 0 ? 2.0f * (ki * conductivity[j]) / sum : 0.0f;
      conductance[k] *= (vi * volume[j]) * (mi + m_inverseMoment[j]) * harmonic;
      others += double{conductance[k]};
    }
    otherTotal[i] = others;
  }
}

/// The resistance of contacts, from both sides by the same operations.
void HeatPairs::resist(const ParticleStore& store, size_t first, size_t last) {
  const uint32_t* body = store.body();
  const float* solid = store.solidFraction();
  const auto film = static_cast<float>(m_options.contactConductance * m_options.spacing);
  for (size_t i = first; i < last; ++i) {
    const auto sumOver = [&](uint32_t from, uint32_t to) {
      double total = 0;
      for (uint32_t k = from; k < to; ++k) {
        const uint32_t j = partner[k];
        const float sum = conductivity[i] + conductivity[j];
        if (body[i] != body[j] && std::max(solid[i], solid[j]) > 0.5f && sum > 0)
          conductance[k] /= 1.0f + 2.0f * (conductivity[i] * conductivity[j]) / (sum * film);
        total += double{conductance[k]};
      }
      return total;
    };
    sameTotal[i] = sumOver(begin[i], same[i]);
    otherTotal[i] = sumOver(other[i], end[i]);
  }
}

void HeatPairs::insulate(size_t first, size_t last) {
  for (size_t i = first; i < last; ++i) {
    const auto sumOver = [&](uint32_t from, uint32_t to) {
      double total = 0;
      for (uint32_t k = from; k < to; ++k) {
        if (isInsulated(i) || isInsulated(partner[k])) conductance[k] = 0;
        total += double{conductance[k]};
      }
      return total;
    };
    sameTotal[i] = sumOver(begin[i], same[i]);
    otherTotal[i] = sumOver(other[i], end[i]);
  }
}

}  // namespace ps
