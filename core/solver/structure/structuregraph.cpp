// SPDX-License-Identifier: Apache-2.0
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>
#include <utility>

namespace ps {

const StructureGraph& ConstraintSystem::graph(size_t particles) {
  if (m_graphValid && m_graph.begin.size() == particles + 1) return m_graph;
  std::vector<uint32_t>& begin = m_graph.begin;
  begin.assign(particles + 1, 0);
  for (const Set& set : m_sets) {
    for (const uint32_t i : set.particles) begin[i + 1] += static_cast<uint32_t>(set.arity) - 1;
  }
  for (size_t i = 0; i < particles; ++i) begin[i + 1] += begin[i];
  m_graph.partner.resize(begin[particles]);
  m_newIndex.assign(begin.begin(), begin.end());
  for (const Set& set : m_sets) {
    for (size_t k = 0; k < set.count; ++k) {
      const uint32_t* p = set.particles.data() + k * set.arity;
      for (size_t a = 0; a < set.arity; ++a) {
        for (size_t b = 0; b < set.arity; ++b) {
          if (a != b) m_graph.partner[m_newIndex[p[a]]++] = p[b];
        }
      }
    }
  }
  addGroupsTo(m_graph, particles);
  m_graphValid = true;
  return m_graph;
}

std::vector<uint32_t> ConstraintSystem::pieces(size_t particles) {
  std::vector<uint32_t> piece;
  findPieces(particles, piece);
  return piece;
}

void ConstraintSystem::findPieces(size_t particles, std::vector<uint32_t>& piece) {
  const StructureGraph& ties = graph(particles);
  piece.assign(particles, kNoPiece);
  // Members of groups, by their serial: first how many, then where the next one goes.
  m_groupBegin.clear();
  for (const uint32_t group : ties.group) {
    if (group >= m_groupBegin.size()) m_groupBegin.resize(group + size_t{1}, 0);
    ++m_groupBegin[group];
  }
  uint32_t members = 0;
  for (uint32_t& begin : m_groupBegin) begin = std::exchange(members, members + begin);
  m_groupMembers.resize(members);
  for (uint32_t i = 0; i < particles; ++i) {
    for (uint32_t k = ties.groupBegin[i]; k < ties.groupBegin[i + 1]; ++k)
      m_groupMembers[m_groupBegin[ties.group[k]]++] = i;
  }
  m_groupSeen.assign(m_groupBegin.size(), 0);
  m_open.clear();
  for (uint32_t first = 0; first < particles; ++first) {
    if (piece[first] != kNoPiece || ties.isFree(first)) continue;
    const auto reach = [&](uint32_t i) {
      if (piece[i] == kNoPiece) piece[i] = first, m_open.push_back(i);
    };
    reach(first);
    while (!m_open.empty()) {
      const uint32_t i = m_open.back();
      m_open.pop_back();
      for (uint32_t k = ties.begin[i]; k < ties.begin[i + 1]; ++k) reach(ties.partner[k]);
      for (uint32_t k = ties.groupBegin[i]; k < ties.groupBegin[i + 1]; ++k) {
        const uint32_t group = ties.group[k];
        if (std::exchange(m_groupSeen[group], uint8_t{1}) != 0) continue;
        const uint32_t begin = group > 0 ? m_groupBegin[group - 1] : 0;  // each has moved on to its end
        for (uint32_t m = begin; m < m_groupBegin[group]; ++m) reach(m_groupMembers[m]);
      }
    }
  }
}

bool ConstraintSystem::groups() const {
  return std::any_of(m_sets.begin(), m_sets.end(),
                     [](const Set& set) { return set.groups && set.groups->count() > 0 && !set.disabled; });
}

bool ConstraintSystem::gathers() const {
  return std::any_of(m_sets.begin(), m_sets.end(), [](const Set& set) {
    return set.neighbour && !set.disabled && std::count(set.used.begin(), set.used.end(), 1) > 0;
  });
}

void ConstraintSystem::findHanging(const ParticleStore& store, std::vector<uint32_t>& hanging) {
  const auto isFixed = [&](uint32_t i) { return store.velocity()[i].w == 0; };
  const auto visit = [](const Set& set, auto&& each) {
    for (const uint32_t i : set.particles) each(i);
    for (size_t g = 0; set.groups && g < set.groups->count(); ++g) {
      for (const uint32_t i : set.groups->members(g)) each(i);
    }
  };
  bool anyFixed = false;
  for (uint32_t i = 0; i < store.size() && !anyFixed; ++i) anyFixed = isFixed(i);
  hanging.clear();
  if (!anyFixed) return;
  m_hangs.assign(store.size(), gathers() ? 1 : 0);
  m_setHangs.assign(m_sets.size(), 0);
  for (bool grown = true; grown;) {  // a plugin's ties hang where one of them does
    grown = false;
    for (size_t s = 0; s < m_sets.size(); ++s) {
      bool any = false;
      if (m_setHangs[s] == 0) visit(m_sets[s], [&](uint32_t i) { any = any || isFixed(i) || m_hangs[i] != 0; });
      if (!any) continue;
      visit(m_sets[s], [&](uint32_t i) { m_hangs[i] = 1; });
      m_setHangs[s] = 1;
      grown = true;
    }
  }
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (m_hangs[i] != 0 && !isFixed(i)) hanging.push_back(i);
  }
}

void ConstraintSystem::addGroupsTo(StructureGraph& graph, size_t particles) const {
  graph.groupBegin.assign(particles + 1, 0);
  const auto eachMember = [&](auto&& visit) {
    uint32_t serial = 0;
    for (const Set& set : m_sets) {
      for (size_t g = 0; set.groups && g < set.groups->count(); ++g, ++serial) {
        for (const uint32_t i : set.groups->members(g)) visit(i, serial);
      }
    }
  };
  eachMember([&](uint32_t i, uint32_t) { ++graph.groupBegin[i + 1]; });
  for (size_t i = 0; i < particles; ++i) graph.groupBegin[i + 1] += graph.groupBegin[i];
  graph.group.resize(graph.groupBegin[particles]);
  // Each beginning moves on to that of the next particle, and then back by one place.
  eachMember([&](uint32_t i, uint32_t serial) { graph.group[graph.groupBegin[i]++] = serial; });
  std::copy_backward(graph.groupBegin.begin(), graph.groupBegin.end() - 1, graph.groupBegin.end());
  graph.groupBegin[0] = 0;
}

}  // namespace ps
