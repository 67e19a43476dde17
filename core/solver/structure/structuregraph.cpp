// SPDX-License-Identifier: Apache-2.0
#include "core/base/parallelarrays.h"
#include "core/solver/structure/constraintsystem.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <span>

namespace ps {
namespace {

/// Ties of a particle by which pieces are joined first.
constexpr uint32_t kSampled = 2;

/// Who belongs together, from any number of threads: each knows somebody of its tree with a lower index, the lowest
/// itself, so that the root does not depend on who came first (Sutton et al. 2018, "Optimizing parallel graph
/// connectivity computation via subgraph sampling").
class Forest {
 public:
  explicit Forest(std::span<uint32_t> parents) : m_parents(parents) {}
  uint32_t parent(uint32_t i) const { return at(i).load(std::memory_order_relaxed); }
  void link(uint32_t i, uint32_t j) const {
    uint32_t a = parent(i), b = parent(j);
    while (a != b) {
      const uint32_t high = std::max(a, b), low = std::min(a, b);
      uint32_t above = parent(high);
      if (above == low) return;
      if (above == high && at(high).compare_exchange_strong(above, low, std::memory_order_relaxed)) return;
      a = parent(parent(high));
      b = parent(low);
    }
  }
  void flatten(uint32_t i) const {
    for (uint32_t a = parent(i), b = parent(a); a != b; a = b, b = parent(a)) at(i).store(b, std::memory_order_relaxed);
  }
  /// The root of most of some that lie evenly apart, where all are flat.
  uint32_t commonest() const {
    std::array<uint32_t, 512> all;
    const auto roots = std::span(all).first(std::min(all.size(), m_parents.size()));
    for (size_t k = 0; k < roots.size(); ++k) roots[k] = m_parents[k * m_parents.size() / roots.size()];
    std::sort(roots.begin(), roots.end());
    uint32_t best = 0;
    size_t most = 0;
    for (size_t first = 0, last = 0; first < roots.size(); first = last) {
      while (last < roots.size() && roots[last] == roots[first]) ++last;
      if (last - first > most) most = last - first, best = roots[first];
    }
    return best;
  }

 private:
  std::atomic_ref<uint32_t> at(uint32_t i) const { return std::atomic_ref(m_parents[i]); }
  std::span<uint32_t> m_parents;
};

}  // namespace

const StructureGraph& ConstraintSystem::graph(size_t particles) {
  if (m_graphValid && m_graph.begin.size() == particles + 1) return m_graph;
  std::vector<uint32_t>& begin = m_graph.begin;
  assignAll(begin, particles + 1, 0u);
  // Constraints of one colour share no particle.
  const auto eachConstraint = [&](const auto& visit) {
    for (const Set& set : m_sets) {
      for (size_t colour = 0; colour + 1 < set.colourStart.size(); ++colour) {
        const size_t start = set.colourStart[colour];
        forChunks(set.colourStart[colour + 1] - start, grain::kConstraints, [&](size_t first, size_t last) {
          for (size_t k = start + first; k < start + last; ++k)
            visit(std::span(set.particles).subspan(k * set.arity, set.arity));
        });
      }
    }
  };
  eachConstraint([&](std::span<const uint32_t> tied) {
    for (const uint32_t i : tied) begin[i + size_t{1}] += static_cast<uint32_t>(tied.size()) - 1;
  });
  sumUp(begin);
  m_graph.partner.resize(begin[particles]);
  assignAll<uint32_t>(m_newIndex, begin);
  eachConstraint([&](std::span<const uint32_t> tied) {
    for (const uint32_t i : tied) {
      for (const uint32_t j : tied) {
        if (i != j) m_graph.partner[m_newIndex[i]++] = j;
      }
    }
  });
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
  piece.resize(particles);
  const auto everywhere = [&](const auto& visit) {
    forChunks(particles, grain::kParticles, [&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) visit(static_cast<uint32_t>(i));
    });
  };
  Forest forest(piece);
  everywhere([&](uint32_t i) { piece[i] = i; });
  m_groupFirst.clear();
  for (const Set& set : m_sets) {
    for (size_t g = 0; set.groups && g < set.groups->count(); ++g) m_groupFirst.push_back(set.groups->members(g)[0]);
  }
  everywhere([&](uint32_t i) {
    for (uint32_t k = ties.groupBegin[i]; k < ties.groupBegin[i + 1]; ++k) forest.link(i, m_groupFirst[ties.group[k]]);
    const uint32_t end = std::min(ties.begin[i + 1], ties.begin[i] + kSampled);
    for (uint32_t k = ties.begin[i]; k < end; ++k) forest.link(i, ties.partner[k]);
  });
  everywhere([&](uint32_t i) { forest.flatten(i); });
  // Most hang together by now: the ties of the largest piece to the others are found from the others' side.
  const uint32_t largest = forest.commonest();
  everywhere([&](uint32_t i) {
    if (forest.parent(i) == largest) return;
    for (uint32_t k = ties.begin[i] + kSampled; k < ties.begin[i + 1]; ++k) forest.link(i, ties.partner[k]);
  });
  everywhere([&](uint32_t i) { forest.flatten(i); });
  everywhere([&](uint32_t i) {
    if (ties.isFree(i)) piece[i] = kNoPiece;
  });
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
  const auto anyOf = [&](const Set& set, const auto& asked) {
    const std::vector<uint32_t>& tied = set.particles;
    const bool any = anyChunk(tied.size(), grain::kNumbers, [&](size_t first, size_t last) {
      return std::any_of(tied.begin() + static_cast<std::ptrdiff_t>(first),
                         tied.begin() + static_cast<std::ptrdiff_t>(last), asked);
    });
    if (any) return true;
    for (size_t g = 0; set.groups && g < set.groups->count(); ++g) {
      const auto members = set.groups->members(g);
      if (std::any_of(members.begin(), members.end(), asked)) return true;
    }
    return false;
  };
  const bool anyFixed = anyChunk(store.size(), grain::kNumbers, [&](size_t first, size_t last) {
    bool any = false;
    for (size_t i = first; i < last && !any; ++i) any = isFixed(static_cast<uint32_t>(i));
    return any;
  });
  hanging.clear();
  if (!anyFixed) return;
  assignAll(m_hangs, store.size(), uint8_t{gathers()});
  m_setHangs.assign(m_sets.size(), 0);
  for (bool grown = true; grown;) {  // a plugin's ties hang where one of them does
    grown = false;
    for (size_t s = 0; s < m_sets.size(); ++s) {
      if (m_setHangs[s] != 0 || !anyOf(m_sets[s], [&](uint32_t i) { return isFixed(i) || m_hangs[i] != 0; })) continue;
      visit(m_sets[s], [&](uint32_t i) { m_hangs[i] = 1; });
      m_setHangs[s] = 1;
      grown = true;
    }
  }
  findIndices(store.size(), hanging, [&](size_t i) { return m_hangs[i] != 0 && !isFixed(static_cast<uint32_t>(i)); });
}

void ConstraintSystem::addGroupsTo(StructureGraph& graph, size_t particles) {
  assignAll(graph.groupBegin, particles + 1, 0u);
  graph.group.clear();
  const bool any =
      std::any_of(m_sets.begin(), m_sets.end(), [](const Set& set) { return set.groups && set.groups->count() > 0; });
  if (!any) return;
  const auto eachMember = [&](const auto& visit) {
    size_t before = 0;  // groups of other sets
    for (const Set& set : m_sets) {
      if (!set.groups) continue;
      set.groups->eachMember([&](uint32_t i, size_t g) { visit(i, static_cast<uint32_t>(before + g)); });
      before += set.groups->count();
    }
  };
  eachMember([&](uint32_t i, uint32_t) { addOne(graph.groupBegin[i + size_t{1}]); });
  sumUp(graph.groupBegin);
  graph.group.resize(graph.groupBegin[particles]);
  assignAll<uint32_t>(m_newIndex, graph.groupBegin);
  eachMember([&](uint32_t i, uint32_t serial) { graph.group[addOne(m_newIndex[i])] = serial; });
  forChunks(particles, grain::kParticles, [&](size_t first, size_t last) {
    const auto at = [&](size_t i) { return graph.group.begin() + static_cast<std::ptrdiff_t>(graph.groupBegin[i]); };
    for (size_t i = first; i < last; ++i) std::sort(at(i), at(i + 1));
  });
}

}  // namespace ps
