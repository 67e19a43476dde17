// SPDX-License-Identifier: Apache-2.0
// The part of ConstraintSystem that hosts plugins of groups.
#include "core/base/error.h"
#include "core/base/parallelarrays.h"
#include "core/solver/matter.h"
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace ps {
namespace {
/// Members that are worth a chunk of their own.
constexpr size_t kMembersPerChunk = 512;
}  // namespace

/// Collects what a plugin adds and removes; it takes effect when the call has returned.
class ConstraintSystem::Groups final : public api::GroupSink {
 public:
  /// `room`: whatever it held.
  Groups(const Set& set, const ParticleStore& store, GroupRoom& room)
      : m_set(set), m_lists(*set.groups), m_particles(store.size()), m_room(room), m_edits(room.edits) {
    m_edits.removed.clear();
    m_edits.ends.clear();
    m_edits.particles.clear();
    m_edits.values.clear();
    m_edits.memberValues.clear();
  }
  void add(const uint32_t* particles, size_t count, const float* values, const float* memberValues) override {
    if (count == 0) throw Error("added a group without members");
    const bool hasValues = values || m_lists.valueCount() == 0,
               hasMembers = memberValues || m_lists.memberValueCount() == 0;
    if (!particles || !hasValues || !hasMembers) throw Error("added a group by a null pointer");
    if (++m_room.serial == 0) m_room.lastUse.clear(), m_room.serial = 1;
    m_room.lastUse.resize(m_particles, 0);  // most calls add nothing
    inSlices(0, count, [&](size_t first, size_t last) { check({particles + first, last - first}); });
    m_edits.particles.insert(m_edits.particles.end(), particles, particles + count);
    m_edits.ends.push_back(m_edits.particles.size());
    m_edits.values.insert(m_edits.values.end(), values, values + m_lists.valueCount());
    m_edits.memberValues.insert(m_edits.memberValues.end(), memberValues,
                                memberValues + count * m_lists.memberValueCount());
  }
  void remove(size_t g) override {
    if (g >= m_lists.count()) throw Error("removed a group that does not exist");
    m_edits.removed.resize(m_lists.count(), 0);
    m_edits.removed[g] = 1;
  }
  void advance(size_t members) override { tellProgress(m_set, members); }
  /// Room for about so many members: to move millions of them takes its time.
  void reserve(size_t members) {
    members += members / 4;
    m_edits.particles.reserve(members);
    m_edits.memberValues.reserve(members * m_lists.memberValueCount());
  }
  const GroupLists::Edits& edits() const { return m_edits; }

 private:
  void check(std::span<const uint32_t> particles) {
    const uint32_t serial = m_room.serial;
    forChunks(particles.size(), grain::kNumbers, [&](size_t first, size_t last) {
      for (const uint32_t i : particles.subspan(first, last - first)) {
        if (i >= m_particles) throw Error("added a group with a particle that does not exist");
        if (std::atomic_ref(m_room.lastUse[i]).exchange(serial, std::memory_order_relaxed) == serial)
          throw Error("added a group that names a particle twice");
      }
    });
  }

  const Set& m_set;
  const GroupLists& m_lists;
  size_t m_particles;
  GroupRoom& m_room;
  GroupLists::Edits& m_edits;
};

template <class Call>
void ConstraintSystem::forGroups(Set& set, const ParticleStore& store, uint32_t substep, uint32_t iteration,
                                 Call&& call) {
  if (!set.groups || set.groups->count() == 0) return;
  GroupLists& groups = *set.groups;
  const auto run = [&](size_t first, size_t last) {
    const CalleeScope callee(set.name.c_str());
    for (size_t next = first; first < last; first = next) {
      const uint32_t body = groups.body(first);
      while (next < last && groups.body(next) == body) ++next;
      GroupLists::Batch batch;
      groups.fill(batch, first, next);
      call(context(set, substepTime(), substep, iteration, body), batch.view);
    }
  };
  moving(set, store, [&] {
    for (size_t colour = 0; colour < groups.colours(); ++colour) {
      const size_t begin = groups.colourStart(colour), count = groups.colourStart(colour + 1) - begin;
      if (count == 0) continue;
      const size_t members = static_cast<size_t>(&groups.members(begin + count - 1).back() - &groups.members(begin)[0]);
      const size_t grain = std::max<size_t>(1, kMembersPerChunk * count / (members + 1));
      if (count <= grain)
        run(begin, begin + count);
      else
        forChunks(
            count, grain, [&](size_t first, size_t last) { run(begin + first, begin + last); }, set.cost);
    }
  });
}

void ConstraintSystem::predictGroups(ParticleStore& store, uint32_t substep) {
  const api::ParticleView view = store.view();
  const api::MovableParticles particles = movable(store, view);
  for (Set& set : m_sets) {
    forGroups(set, store, substep, 0,
              [&](const auto& c, const api::GroupBatch& batch) { set.group->predict(c, particles, batch); });
  }
}

void ConstraintSystem::projectGroups(ParticleStore& store, uint32_t substep, uint32_t iteration) {
  const api::ParticleView view = store.view();
  const api::MovableParticles particles = movable(store, view);
  for (Set& set : m_sets) {
    forGroups(set, store, substep, iteration,
              [&](const auto& c, const api::GroupBatch& batch) { set.group->project(c, particles, batch); });
  }
}

void ConstraintSystem::deriveGroupVelocities(ParticleStore& store, uint32_t substep) {
  const api::ParticleView view = store.view();
  const api::MovableParticles particles = movable(store, view);
  for (Set& set : m_sets) {
    forGroups(set, store, substep, 0,
              [&](const auto& c, const api::GroupBatch& batch) { set.group->deriveVelocities(c, particles, batch); });
  }
}

void ConstraintSystem::buildGroups(Set& set, const ParticleStore& store, const Neighbours& neighbours,
                                   std::span<const uint32_t> members) {
  GroupLists::Batch all;
  set.groups->fill(all, 0, set.groups->count());
  GroupRoom room;  // of new matter, of which there may be millions
  Groups sink(set, store, room);
  sink.reserve(beginTying(set, members.size()));
  if (guarded(set, [&] {
        set.group->build(context(set, m_settings.dt, 0, 0, store.body()[members[0]]), store.view(), neighbours.view(),
                         {members.data(), members.size()}, all.view, sink);
      })) {
    set.groups->apply(sink.edits(), {store.body(), store.size()});
    m_graphValid = false;
  }
}

bool ConstraintSystem::groupTopology(Set& set, const ParticleStore& store, const Neighbours& neighbours,
                                     SplitGroups* split) {
  if (set.disabled) return false;
  GroupLists::Batch all;
  set.groups->fill(all, 0, set.groups->count());
  Groups sink(set, store, m_groupRoom);
  if (!guarded(set, [&] {
        set.group->topology(context(set, m_settings.dt, 0, 0), store.view(), neighbours.view(), all.view, sink);
      })) {
    return true;
  }
  set.groups->forgetChanges();
  if (sink.edits().empty()) return false;
  if (split) *split = set.groups->splitBy(store, sink.edits());
  set.groups->apply(sink.edits(), {store.body(), store.size()});
  m_graphValid = false;
  return true;
}

double ConstraintSystem::groupEnergy(Set& set, const ParticleStore& store) {
  double sum = 0;
  GroupLists& groups = *set.groups;
  guarded(set, [&] {
    for (size_t first = 0, next = 0; first < groups.count(); first = next) {
      while (next < groups.count() && groups.body(next) == groups.body(first)) ++next;
      GroupLists::Batch batch;
      groups.fill(batch, first, next);
      const double joules =
          set.group->energy(context(set, substepTime(), 0, 0, groups.body(first)), store.view(), batch.view);
      if (!std::isfinite(joules)) throw Error("its energy is not a finite number");
      sum += joules;
    }
  });
  return sum;
}

void ConstraintSystem::putGroupsBack(Set& set, ParticleStore& store, std::span<const CopiedGroup> copies) {
  if (copies.empty()) return;
  const std::vector<uint8_t> returned = set.groups->putBack(store, copies);
  m_graphValid = false;
  GroupLists::Batch all;
  set.groups->fill(all, 0, set.groups->count());
  const api::ParticleView view = store.view();
  guarded(set, [&] {
    set.group->restoreMembers(context(set, m_settings.dt, 0, 0), movable(store, view), all.view, returned.data());
  });
}

void ConstraintSystem::findGroupMembers(const ParticleStore& store, std::vector<uint8_t>& marks) const {
  assignAll(marks, store.size(), uint8_t{0});
  for (const Set& set : m_sets) {
    if (set.groups)
      set.groups->eachMember(
          [&](uint32_t i, size_t) { std::atomic_ref(marks[i]).store(1, std::memory_order_relaxed); });
  }
}

}  // namespace ps
