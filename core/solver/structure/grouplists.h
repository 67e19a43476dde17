// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"
#include "core/particles/particlestore.h"
#include "core/solver/structure/flatparts.h"

#include <phasesketch/constraint.h>

#include <array>
#include <string_view>
#include <vector>

namespace ps {

class StateReader;
class StateWriter;

/// A group outside a solver, by the ids of its members.
struct CopiedGroup {
  std::vector<uint32_t> id;
  std::vector<uint8_t> extracted;  ///< 1 for those that went, 0 for companions that stayed
  std::vector<float> values, memberValues;
};

/// Groups that came apart by a cut, and the members of what came of them, by ids.
struct SplitGroups {
  std::vector<CopiedGroup> before;
  std::vector<std::vector<uint32_t>> after;
};

/// Index lists and values of the groups of one constraint plugin. Groups lie in order of colour, and within a
/// colour of body: those of one colour share no particle. Colours are dealt out anew, in order, whenever groups come or
/// go, so that they depend on the history of the scene alone.
class GroupLists {
 public:
  static constexpr size_t kMostValues = 16;

  /// What a plugin adds and removes; it takes effect when the call has returned.
  struct Edits {
    std::vector<uint8_t> removed;  ///< per group; empty: none
    std::vector<size_t> ends;      ///< of each new group's particles
    std::vector<uint32_t> particles;
    std::vector<float> values, memberValues;  ///< row by row
    bool empty() const { return removed.empty() && particles.empty(); }
  };
  /// A batch with the pointers that it needs.
  struct Batch {
    std::array<float*, kMostValues> values{}, memberValues{};
    api::GroupBatch view{};
  };

  GroupLists(size_t values, size_t memberValues);

  size_t count() const { return m_begin.size() - 1; }
  size_t colours() const { return m_colourStart.size() - 1; }
  /// First group of a colour, or count() for the last.
  size_t colourStart(size_t colour) const { return m_colourStart[colour]; }
  std::span<const uint32_t> members(size_t group) const {
    return {m_particles.data() + m_begin[group], m_begin[group + 1] - m_begin[group]};
  }
  /// The body that the group belongs to: that of its first member when it was added.
  uint32_t body(size_t group) const { return m_body[group]; }
  /// Particles are of other bodies by now, which `body` has by their indices: so is each group.
  void bodiesChanged(std::span<const uint32_t> body);
  size_t valueCount() const { return m_values.size(); }
  size_t memberValueCount() const { return m_memberValues.size(); }
  /// visit(i, g) for each member i of each group g, by any thread.
  template <class Visit>
  void eachMember(const Visit& visit) const {
    forChunks(m_particles.size(), grain::kNumbers, [&](size_t first, size_t last) {
      eachFlatPart(m_begin, first, last, [&](size_t g, size_t from, size_t to) {
        for (const uint32_t i : members(g).subspan(from, to - from)) visit(i, g);
      });
    });
  }
  /// Groups [first, last); valid until the lists change. `batch` is filled in place, because it points into itself.
  void fill(Batch& batch, size_t first, size_t last);

  void clear();
  /// `body`: of each particle.
  void apply(const Edits& edits, std::span<const uint32_t> body);
  /// newIndex[old index]; kGone drops the member, and the group with its last one.
  void renumber(std::span<const uint32_t> newIndex);
  void forgetChanges() { m_changed.assign(count(), 0); }
  /// Groups with a member of those marked have changed.
  void noteChanges(std::span<const uint8_t> marked);

  /// What edits do, before they take effect.
  SplitGroups splitBy(const ParticleStore& store, const Edits& edits) const;
  /// Puts groups in the place of what came of them; those of which a member is gone stay apart.
  void rejoin(const ParticleStore& store, const SplitGroups& split);

  std::vector<CopiedGroup> copy(const ParticleStore& store, std::span<const uint32_t> ascending) const;
  /// Members that were taken out join the group that now holds most of their old companions; without one the copied
  /// group stands again, of all that live. Returns 1 for every place whose member came back.
  std::vector<uint8_t> putBack(const ParticleStore& store, std::span<const CopiedGroup> copies);
  /// `room`: of the blocks' names.
  void save(StateWriter& writer, std::string_view room) const;
  void restore(const StateReader& reader, std::string_view room, size_t particles);

  static constexpr uint32_t kGone = ~0u;

 private:
  /// Where a group comes from: it is there already, or the next of those that are added.
  struct Source {
    std::span<const uint32_t> particles;
    size_t from;  ///< its first place, here or among those that are added
    uint32_t group;
    uint32_t body;
    bool added;
  };
  void arrange(const std::vector<Source>& sources, const Edits& edits, size_t particles);
  static size_t colourAll(const std::vector<Source>& sources, size_t particles, std::vector<size_t>& colourOf);
  static bool anyShared(const std::vector<Source>& sources, size_t particles);
  void copyMembers(const GroupLists& old, const std::vector<Source>& sources, std::span<const size_t> order,
                   const Edits& edits);
  /// The group that holds most of those marked, or count().
  size_t homeOf(std::span<const uint8_t> companion) const;

  std::vector<size_t> m_begin{0};
  std::vector<uint32_t> m_particles;
  std::vector<std::vector<float>> m_values, m_memberValues;  ///< [value][group], [value][place]
  /// What the lists of members were before: groups come and go in most frames while matter melts.
  std::vector<uint32_t> m_spareParticles;
  std::vector<std::vector<float>> m_spareValues;
  std::vector<uint8_t> m_changed;
  std::vector<uint32_t> m_body;
  std::vector<size_t> m_colourStart{0};
};

}  // namespace ps
