// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "rotation.h"

#include <phasesketch/constraint.h>

#include <span>
#include <vector>

namespace ps::constraint {

/// A body in the making: places of a group's members that are left, and particles that have come to them.
struct RigidPiece {
  size_t group = 0;            ///< of the batch; its count for a piece that begins
  bool whole = false;          ///< all members of the group are left, and not listed
  std::vector<uint32_t> kept;  ///< else those that are, ascending
  std::vector<uint32_t> joined;
  bool changed = false;

  /// How many members of the group are left, and the place of each.
  size_t left(const api::GroupBatch& all) const {
    return whole ? all.begin[group + 1] - all.begin[group] : kept.size();
  }
  size_t placeOf(const api::GroupBatch& all, size_t n) const { return whole ? all.begin[group] + n : kept[n]; }
};

/// Members that have melted leave their bodies; what is left falls into what hangs together. All of a body is looked at
/// only where what is near those that leave does not tell.
class RigidSplitting {
 public:
  RigidSplitting(const api::ConstraintContext& context, const api::ParticleView& particles,
                 const api::NeighbourView& lists, const api::GroupBatch& all, const api::Threads* threads)
      : m_context(context), m_p(particles), m_lists(lists), m_all(all), m_threads(threads) {}

  /// Pieces of one group after the other; marks groups that do not stay as they are.
  std::vector<RigidPiece> run(std::vector<uint8_t>& gone);

 private:
  /// Melted members that hang together, of all of them in order of their lumps.
  struct Lump {
    size_t first, last;
  };
  std::vector<uint32_t> placesBut(size_t first, size_t last, std::span<const uint32_t> melted) const;
  void split(size_t g, std::span<const uint32_t> melted, std::vector<RigidPiece>& pieces, std::vector<uint8_t>& gone);
  bool staysWhole(size_t g, std::span<const uint32_t> melted);
  bool rimsHangTogether(std::span<const uint32_t> melted) const;
  std::vector<Lump> gatherLumps(std::span<const uint32_t> melted, std::vector<uint32_t>& places) const;
  bool rimHangsTogether(std::span<const uint32_t> lump) const;
  template <class Visit>
  void forHanging(size_t k, const Visit& visit) const;
  bool hangTogether(size_t k, size_t other) const;
  bool isCut(size_t k, size_t other) const {
    return m_context.cuts && m_context.cuts->between(m_all.particles[k], m_all.particles[other]);
  }
  bool isMelted(size_t k) const { return m_p.motion[m_all.particles[k]] != api::Motion::Solid; }

  const api::ConstraintContext& m_context;
  const api::ParticleView& m_p;
  const api::NeighbourView& m_lists;
  const api::GroupBatch& m_all;
  const api::Threads* m_threads;
  std::vector<uint32_t> m_placeOf;  ///< of particles in the group that is split
};

}  // namespace ps::constraint
