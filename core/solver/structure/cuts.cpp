// SPDX-License-Identifier: Apache-2.0
#include "core/solver/structure/cuts.h"

#include <algorithm>
#include <iterator>

namespace ps {
namespace {

/// Places of the two in a store; its size for one that is gone.
std::pair<size_t, size_t> placesOf(const ParticleStore& store, Cuts::Pair pair) {
  return {store.indexOf(Cuts::lower(pair)), store.indexOf(Cuts::higher(pair))};
}

}  // namespace

std::vector<Cuts::Pair> Cuts::add(std::span<const Pair> pairs) {
  std::vector<Pair> sorted(pairs.begin(), pairs.end()), fresh, all;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::set_difference(sorted.begin(), sorted.end(), m_pairs.begin(), m_pairs.end(), std::back_inserter(fresh));
  if (fresh.empty()) return fresh;
  all.reserve(m_pairs.size() + fresh.size());
  std::merge(m_pairs.begin(), m_pairs.end(), fresh.begin(), fresh.end(), std::back_inserter(all));
  m_pairs = std::move(all);
  return fresh;
}

void Cuts::remove(std::span<const Pair> ascending) {
  if (ascending.empty()) return;
  std::erase_if(m_pairs, [&](Pair pair) { return std::binary_search(ascending.begin(), ascending.end(), pair); });
}

void Cuts::dropLoose(const ParticleStore& store) {
  const auto isLoose = [&](size_t i) { return i >= store.size() || !api::holds(store.motion()[i]); };
  std::erase_if(m_pairs, [&](Pair pair) {
    const auto [a, b] = placesOf(store, pair);
    return isLoose(a) || isLoose(b);
  });
}

std::vector<Cuts::Pair> Cuts::of(const ParticleStore& store, std::span<const uint32_t> ascending) const {
  std::vector<Pair> found;
  std::copy_if(m_pairs.begin(), m_pairs.end(), std::back_inserter(found), [&](Pair pair) {
    const auto [a, b] = placesOf(store, pair);
    return std::binary_search(ascending.begin(), ascending.end(), a) ||
           std::binary_search(ascending.begin(), ascending.end(), b);
  });
  return found;
}

std::vector<Cuts::Pair> Cuts::among(const ParticleStore& store, std::span<const uint8_t> marked) const {
  std::vector<Pair> found;
  std::copy_if(m_pairs.begin(), m_pairs.end(), std::back_inserter(found), [&](Pair pair) {
    const auto [a, b] = placesOf(store, pair);
    return a < store.size() && b < store.size() && marked[a] != 0 && marked[b] != 0;
  });
  return found;
}

const api::CutView* Cuts::view(const ParticleStore& store) {
  if (m_pairs.empty()) return nullptr;
  m_begin.assign(store.size() + 2, 0);
  const auto forEach = [&](auto&& visit) {
    for (const Pair pair : m_pairs) {
      const auto [a, b] = placesOf(store, pair);
      if (a < store.size() && b < store.size()) visit(static_cast<uint32_t>(a), static_cast<uint32_t>(b));
    }
  };
  // One place further on, so that filling in moves each beginning to where it belongs.
  forEach([&](uint32_t a, uint32_t b) { ++m_begin[a + size_t{2}], ++m_begin[b + size_t{2}]; });
  for (size_t i = 2; i < m_begin.size(); ++i) m_begin[i] += m_begin[i - 1];
  m_partner.resize(m_begin.back());
  forEach([&](uint32_t a, uint32_t b) {
    m_partner[m_begin[a + size_t{1}]++] = b;
    m_partner[m_begin[b + size_t{1}]++] = a;
  });
  m_view = {m_begin.data(), m_partner.data()};
  return &m_view;
}

}  // namespace ps
