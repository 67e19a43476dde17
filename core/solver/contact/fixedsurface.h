// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/contact/latticesurface.h"

#include <span>
#include <vector>

namespace ps {

/// The surface of fixed matter that nothing ties, kept while nothing of it moves: lists of neighbours are made anew
/// several times a frame where matter falls fast, and tables and moulds stay what they are. What is kept is what would
/// be found anew, to the bit, so that it is no state.
class FixedSurface {
 public:
  /// Forgets all: what counts as near has changed.
  void clear() { m_slot.clear(), m_fixed.clear(), m_at.clear(), m_kept.clear(); }
  /// Forgets all where something fixed has come, gone or moved, by the places that lists were made for.
  void refresh(const ParticleStore& store, std::span<const api::Float4> noted);
  /// Whether it knows the neighbours of a particle, which it then hands over; from several threads.
  bool recall(uint32_t i, LatticeSurface::Own& own) const {
    if (m_slot[i] == LatticeSurface::kNone) return false;
    own = m_kept[m_slot[i]].own;
    return true;
  }
  bool knows(uint32_t i) const { return i < m_slot.size() && m_slot[i] != LatticeSurface::kNone; }
  /// In an order that no list decides.
  void keep(uint32_t i, LatticeSurface::Own& own);
  /// The normal of a particle that it knows, or none yet.
  const LatticeSurface::Normal* normalOf(uint32_t i) const {
    const Kept& kept = m_kept[m_slot[i]];
    return kept.hasNormal ? &kept.normal : nullptr;
  }
  void keepNormal(uint32_t i, const LatticeSurface::Normal& normal) {
    Kept& kept = m_kept[m_slot[i]];
    kept.normal = normal;
    kept.hasNormal = true;
  }

 private:
  struct Kept {
    LatticeSurface::Own own;
    LatticeSurface::Normal normal;
    bool hasNormal = false;
  };
  std::vector<uint32_t> m_fixed, m_now;  ///< indices, ascending
  std::vector<api::Float4> m_at;         ///< where these were noted
  std::vector<uint32_t> m_slot;          ///< by particle
  std::vector<Kept> m_kept;
};

}  // namespace ps
