// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/particles/particlestore.h"

#include <phasesketch/constraint.h>

#include <cstdint>
#include <span>
#include <vector>

namespace ps {

/// Between whom a hand has cut, by ids, for as long as both are solid. Why pairs, and not a mark for each particle: a
/// body that is cut step by step must not close behind the blade, nor open where two cuts end side by side.
class Cuts {
 public:
  using Pair = uint64_t;  ///< the lower id in its upper half

  Cuts() = default;
  /// Of a state: in any order.
  explicit Cuts(std::vector<Pair> pairs) { add(pairs); }
  static Pair pairOf(uint32_t a, uint32_t b) { return a < b ? Pair{a} << 32 | b : Pair{b} << 32 | a; }
  static uint32_t lower(Pair pair) { return static_cast<uint32_t>(pair >> 32); }
  static uint32_t higher(Pair pair) { return static_cast<uint32_t>(pair); }

  bool empty() const { return m_pairs.empty(); }
  std::span<const Pair> pairs() const { return m_pairs; }  ///< ascending
  /// Those of some pairs that were not there yet, ascending.
  std::vector<Pair> add(std::span<const Pair> pairs);
  void remove(std::span<const Pair> ascending);
  /// Drops pairs of which one has melted or is gone: what freezes again joins again.
  void dropLoose(const ParticleStore& store);
  /// Pairs with one of these ascending indices.
  std::vector<Pair> of(const ParticleStore& store, std::span<const uint32_t> ascending) const;
  /// Pairs of which both are marked, by index.
  std::vector<Pair> among(const ParticleStore& store, std::span<const uint8_t> marked) const;
  /// By the particles' indices, until those or the pairs change; nullptr where there are none.
  const api::CutView* view(const ParticleStore& store);

 private:
  std::vector<Pair> m_pairs;
  std::vector<uint32_t> m_begin, m_partner;
  api::CutView m_view{};
};

}  // namespace ps
