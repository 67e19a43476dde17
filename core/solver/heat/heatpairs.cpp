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

/// By what the gradient of a cubic lattice's half space is multiplied, m3, so that all that a column of particles
/// before it sees of it adds up to the area of one.
double filmScaleOf(const Kernel& kernel, double dx) {
  const int reach = static_cast<int>(std::ceil(kernel.supportRadius() / dx));
  double sum = 0;
  for (int n = 1; n <= reach; ++n) {
    for (int y = -reach; y <= reach; ++y) {
      for (int z = -reach; z <= reach; ++z) {
        const double r = dx * std::sqrt(static_cast<double>(n * n + y * y + z * z));
        if (r < kernel.supportRadius()) sum += n * n * -kernel.gradient(r);
      }
    }
  }
  return 1 / (sum * dx * dx * dx * dx * dx);
}

}  // namespace

void HeatPairs::prepare(size_t count, size_t slots, PairRoom& room) {
  for (auto* list : {&begin, &same, &other, &end}) list->resize(count);
  for (auto* values : {&conductivity, &volume, &filled, &immersion, &m_inverseMoment}) values->resize(count + 1);
  sameTotal.resize(count);
  otherTotal.resize(count);
  makeRoomFor(room.partner, slots);
  makeRoomFor(room.value, slots);
  partner = room.partner;
  conductance = room.value;
}

void HeatPairs::build(const ParticleStore& store, const api::NeighbourView& lists,
                      std::span<const BakedMaterial> materials, const Options& options, PairRoom* room) {
  m_options = options;
  const size_t n = store.size();
  if (n == 0) return;
  prepare(n, lists.slots, room ? *room : m_ownRoom);
  m_oneMaterial = materials.size() == 1 && options.convection.empty();
  if (!options.convection.empty()) {
    m_filmScale = filmScaleOf(Kernel(options.kernel, options.support), options.spacing);
    m_film.resize(n);
  }
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
  if (!options.convection.empty()) forChunks(n, grain::kNeighbours, [&](size_t a, size_t b) { seeFilms(store, a, b); });
  const auto second = [&](size_t a, size_t b) {
    conduct(a, b);
    if (m_options.contactConductance > 0) resist(store, a, b);
    if (!m_options.insulated.empty()) insulate(a, b);
  };
  forChunks(n, grain::kNeighbours, second);
}

/// `kernel` holds W by slot, from the particle's first one on.
float HeatPairs::condensedAround(const ParticleStore& store, size_t i, const float* kernel) const {
  const double self = Kernel(m_options.kernel, m_options.support).value(0);
  double around = 0;
  const auto add = [&](uint32_t from, uint32_t to) {
    for (uint32_t k = from; k < to; ++k) {
      const uint32_t j = partner[k];
      if (store.motion()[j] != api::Motion::Gas) around += double{store.position()[j].w} * double{kernel[k - begin[i]]};
    }
  };
  add(begin[i], same[i]);
  add(other[i], end[i]);
  return static_cast<float>(std::min(1.0, around / std::max(0.2, 1 - double{store.position()[i].w} * self)));
}

/// Writes partners within the support, and their squared distances into the room: those of the particle's own material
/// from the front of its slots, others from the back.
HeatSlots HeatPairs::findPartners(const ParticleStore& store, const api::NeighbourView& lists, uint32_t i, Room& room) {
  const float limit = static_cast<float>(m_options.support * m_options.support), tiny = 1e-12f * limit;
  const uint32_t first = lists.begin[i], *list = lists.index + first;
  const size_t count = lists.last[i] - first;
  HeatSlots slots{first, first, lists.end[i], lists.end[i]};
  if (const size_t needed = slots.end - first; room.partner.size() < needed) {
    room.partner.resize(2 * needed);
    for (auto* values : {&room.found, &room.square, &room.kernel}) values->resize(2 * needed);
  }
  uint32_t* found = m_oneMaterial ? &partner[first] : room.partner.data();
  float* square = m_oneMaterial ? room.square.data() : room.found.data();
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
    // A film between the two does not go by Kirchhoff's potentials.
    const bool alike = material[found[k]] == own && !isFluidBehind(i) && !isFluidBehind(found[k]);
    const uint32_t slot = alike ? slots.same++ : --slots.other;
    partner[slot] = found[k];
    room.square[slot - first] = square[k];
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
    const HeatSums sums = sumHeatSlots(kernel, slots, partner.data(), volume.data(), room.square.data(),
                                       room.kernel.data(), conductance.data());
    const float full = volume[i] * selfKernel + sums.filled, m = std::clamp(sums.moment / 3, 0.8f, 1.25f);
    m_inverseMoment[i] = m_options.momentCorrection && full > kFullSupport ? 1 / m : 1.0f;
    filled[i] = full;
    immersion[i] = store.gasFraction()[i] > 0 ? condensedAround(store, i, room.kernel.data()) : 0.0f;
  }
}

void HeatPairs::conduct(size_t first, size_t last) {
  const bool films = !m_options.convection.empty();
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
      if (films && (isFluidBehind(i) || isFluidBehind(j)))
        conductance[k] = throughFilm(static_cast<uint32_t>(i), j, conductance[k]);
      else
        conductance[k] *= (vi * volume[j]) * (mi + m_inverseMoment[j]) * harmonic;
      others += double{conductance[k]};
    }
    otherTotal[i] = others;
  }
}

/// What each particle sees of surfaces with a fluid behind them, per volume and slope of the kernel: m_film times both
/// is the share of a pair in its area. Steps of a lattice along a surface do not show: they cancel in the gradient.
void HeatPairs::seeFilms(const ParticleStore& store, size_t first, size_t last) {
  for (size_t i = first; i < last; ++i) {
    double x = 0, y = 0, z = 0, total = 0;
    for (uint32_t k = other[i]; k < end[i] && !isFluidBehind(i); ++k) {
      if (!isFluidBehind(partner[k])) continue;
      const double weight = double{volume[partner[k]]} * double{conductance[k]};
      const auto [dx, dy, dz, unused] = store.separation(static_cast<uint32_t>(i), partner[k]);
      x += weight * double{dx}, y += weight * double{dy}, z += weight * double{dz};
      total += weight;
    }
    const double seen = m_filmScale * double{volume[i]} * std::sqrt(x * x + y * y + z * z);
    m_film[i] = total > 0 ? static_cast<float>(seen / total) : 0.0f;
  }
}

/// W/K for a kernel's slope, where one of the two, and only one, is a fluid: from both sides the same, for all that is
/// not symmetric is asked of that one or of the other.
float HeatPairs::throughFilm(uint32_t i, uint32_t j, float slope) const {
  const bool fluid = isFluidBehind(i);
  if (fluid == isFluidBehind(j)) return 0;
  const uint32_t behind = fluid ? i : j, matter = fluid ? j : i;
  const double k = double{conductivity[matter]};
  if (!(k > 0)) return 0;
  const double through = 1 / (1 / double{m_options.convection[behind]} + 0.5 * m_options.spacing / k);
  return static_cast<float>(double{m_film[matter]} * double{volume[behind]} * double{slope} * through);
}

/// The resistance of contacts, from both sides by the same operations; a film has its own.
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
        const bool films = isFluidBehind(i) || isFluidBehind(j);
        if (!films && body[i] != body[j] && std::max(solid[i], solid[j]) > 0.5f && sum > 0)
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
