// SPDX-License-Identifier: Apache-2.0
#include "core/solver/heat/heatpairs.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace ps {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Sum of V W below which a particle's surroundings count as cut off by a surface.
constexpr float kFullSupport = 0.95f;

}  // namespace

void HeatPairs::prepare(size_t count, size_t slots) {
  for (auto* list : {&begin, &same, &other, &end}) list->resize(count);
  for (auto* values : {&conductivity, &volume, &filled, &immersion, &m_inverseMoment}) values->resize(count + 1);
  sameTotal.resize(count);
  otherTotal.resize(count);
  if (partner.size() >= slots) return;
  const size_t room = slots + slots / 4;  // lists breathe; do not allocate each time they grow by one
  partner.resize(room);
  conductance.resize(room);
  m_square.resize(room);
  m_kernel.resize(room);
}

void HeatPairs::build(const ParticleStore& store, const api::NeighbourView& lists,
                      std::span<const BakedMaterial> materials, const Options& options) {
  m_options = options;
  const size_t n = store.size();
  if (n == 0) return;
  prepare(n, lists.end[n - 1]);
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
  parallelFor(n, grain::kNeighbours, std::cref(matter));
  const auto first = [&](size_t a, size_t b) {
    store.period().any() ? measure<true>(store, lists, a, b) : measure<false>(store, lists, a, b);
  };
  parallelFor(n, grain::kNeighbours, std::cref(first));
  const auto second = [&](size_t a, size_t b) {
    conduct(a, b);
    if (m_options.contactConductance > 0) resist(store, a, b);
  };
  parallelFor(n, grain::kNeighbours, std::cref(second));
}

/// Writes -F into `conductance` and W, from squared distances; plain arithmetic without branches, which compilers
/// turn into vectors with the same bits on every instruction set.
void HeatPairs::differentiate(uint32_t first, uint32_t last) {
  const float radius = static_cast<float>(m_options.support), inverse = 1.0f / radius;
  const double r3 = m_options.support * m_options.support * m_options.support;
  const float* __restrict r2 = m_square.data();
  float* __restrict g = conductance.data();
  float* __restrict w = m_kernel.data();
  if (m_options.kernel == KernelShape::CubicSpline) {
    const float scale = static_cast<float>(8 / (kPi * r3)),
                slope = static_cast<float>(8 / (kPi * r3 * m_options.support));
    for (uint32_t k = first; k < last; ++k) {
      const float r = std::sqrt(r2[k]), q = r * inverse;
      const float a = 1.0f - q, b = std::max(0.5f - q, 0.0f);
      w[k] = scale * (2.0f * a * a * a - 8.0f * b * b * b);
      g[k] = slope / r * (6.0f * a * a - 24.0f * b * b);
    }
  } else {
    const float scale = static_cast<float>(21 / (2 * kPi * r3));
    const float slope = static_cast<float>(21 / (2 * kPi * r3 * m_options.support));
    for (uint32_t k = first; k < last; ++k) {
      const float r = std::sqrt(r2[k]), q = r * inverse, a = 1.0f - q;
      w[k] = scale * (a * a * a * a * (1.0f + 4.0f * q));
      g[k] = slope / r * (20.0f * q * a * a * a);
    }
  }
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

template <bool kPeriodic>
void HeatPairs::measure(const ParticleStore& store, const api::NeighbourView& lists, size_t first, size_t last) {
  const float limit = static_cast<float>(m_options.support * m_options.support), tiny = 1e-12f * limit;
  const api::Float4* x = store.position();
  const uint32_t* material = store.material();
  const Period& period = store.period();
  const float selfKernel = static_cast<float>(Kernel(m_options.kernel, m_options.support).value(0));
  for (size_t i = first; i < last; ++i) {
    uint32_t front = lists.begin[i], back = lists.end[i];
    begin[i] = front;
    end[i] = back;
    const api::Float4 xi = x[i];
    const auto square = [&](uint32_t j) {
      float dx = xi.x - x[j].x, dy = xi.y - x[j].y, dz = xi.z - x[j].z;
      if constexpr (kPeriodic) {
        dx = period.shortest(dx, 0), dy = period.shortest(dy, 1), dz = period.shortest(dz, 2);
      }
      return std::max(dx * dx + dy * dy + dz * dz, tiny);
    };
    if (m_oneMaterial) {  // without a branch: entries of the skin are written and overwritten
      for (uint32_t k = lists.begin[i]; k < lists.last[i]; ++k) {
        const uint32_t j = lists.index[k];
        const float r2 = square(j);
        partner[front] = j;
        m_square[front] = r2;
        front += r2 < limit;
      }
    } else {
      for (uint32_t k = lists.begin[i]; k < lists.last[i]; ++k) {
        const uint32_t j = lists.index[k];
        const float r2 = square(j);
        if (!(r2 < limit)) continue;
        const uint32_t slot = material[j] == material[i] ? front++ : --back;
        partner[slot] = j;
        m_square[slot] = r2;
      }
    }
    same[i] = front;
    other[i] = back;
    differentiate(begin[i], front);
    differentiate(back, end[i]);
    float moment = 0, full = volume[i] * selfKernel;
    const auto add = [&](uint32_t from, uint32_t to) {
      for (uint32_t k = from; k < to; ++k) {
        const float v = volume[partner[k]];
        moment += v * (conductance[k] * m_square[k]);
        full += v * m_kernel[k];
      }
    };
    add(begin[i], front);
    add(back, end[i]);
    const float m = std::clamp(moment / 3, 0.8f, 1.25f);
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

}  // namespace ps
