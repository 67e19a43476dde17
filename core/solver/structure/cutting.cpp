// SPDX-License-Identifier: Apache-2.0
// What a hand does to ties: cuts them along a blade, welds what touches, and undo of both.
#include "core/solver/matter.h"
#include "core/solver/structure/constraintsink.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Spacings beyond a blade at which the particles of a tie may lie that it meets: of stretched cloth the next but one.
constexpr double kLongestTie = 4;

Vector3 fromCentre(const ParticleStore& store, uint32_t i, const Blade& blade) {
  api::Float4 offset = float4Of(vectorOf(store.position()[i]) - blade.centre, 0);
  store.period().shorten(offset.x, offset.y, offset.z);
  return vectorOf(offset);
}

/// Whether a blade meets the way between two places, as they lie about its centre.
bool meets(const Blade& blade, const Vector3& from, const Vector3& way) {
  double share = 0;
  if (blade.isDisc()) {
    const double before = blade.normal.dot(from), after = before + blade.normal.dot(way);
    if ((before < 0) == (after < 0)) return false;
    share = before / (before - after);
  } else if (const double length = way.squaredNorm(); length > 0) {
    share = std::clamp(-from.dot(way) / length, 0.0, 1.0);
  }
  return (from + share * way).squaredNorm() < blade.radius * blade.radius;
}

/// Where blades may meet something, and where nothing is to be cut.
class Reach {
 public:
  Reach(const ParticleStore& store, std::span<const Blade> blades, std::span<const uint8_t> isSpared, double spacing)
      : m_store(store),
        m_blades(blades),
        m_isSpared(isSpared),
        m_beyond(kLongestTie * spacing),
        m_isNear(store.size()) {
    // A ball around all of them leaves out most of a scene by one look.
    for (const Blade& blade : blades) m_all = std::max(m_all, offset(blade.centre).norm() + blade.radius + m_beyond);
    forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) m_isNear[i] = findNear(static_cast<uint32_t>(i)) ? 1 : 0;
    });
    findIndices(store.size(), m_near, [&](size_t i) { return m_isNear[i] != 0; });
  }
  std::span<const uint32_t> near() const { return m_near; }
  bool isCut(uint32_t i, uint32_t j) const {
    if (m_isNear[i] == 0 || isSpared(j)) return false;
    const Vector3 way = vectorOf(m_store.separation(j, i));
    return std::any_of(m_blades.begin(), m_blades.end(),
                       [&](const Blade& blade) { return meets(blade, fromCentre(m_store, i, blade), way); });
  }
  /// Of a tie of several: whether a blade parts any two of them.
  bool isCut(std::span<const uint32_t> tied) const {
    const auto isNear = [&](uint32_t i) { return m_isNear[i] != 0; };
    if (std::none_of(tied.begin(), tied.end(), isNear)) return false;
    if (std::any_of(tied.begin(), tied.end(), [&](uint32_t i) { return isSpared(i); })) return false;
    for (size_t a = 0; a < tied.size(); ++a) {
      for (size_t b = a + 1; b < tied.size(); ++b) {
        if (isCut(tied[a], tied[b])) return true;
      }
    }
    return false;
  }

 private:
  bool isSpared(uint32_t i) const {
    const uint32_t body = m_store.body()[i];
    return body < m_isSpared.size() && m_isSpared[body] != 0;
  }
  /// From the middle of the first blade.
  Vector3 offset(const Vector3& place) const {
    api::Float4 from = float4Of(place - m_blades.front().centre, 0);
    m_store.period().shorten(from.x, from.y, from.z);
    return vectorOf(from);
  }
  bool findNear(uint32_t i) const {
    if (m_blades.empty() || offset(vectorOf(m_store.position()[i])).squaredNorm() > m_all * m_all) return false;
    return !isSpared(i) && std::any_of(m_blades.begin(), m_blades.end(), [&](const Blade& blade) {
      const double reach = blade.radius + m_beyond;
      return fromCentre(m_store, i, blade).squaredNorm() < reach * reach;
    });
  }

  const ParticleStore& m_store;
  std::span<const Blade> m_blades;
  std::span<const uint8_t> m_isSpared;
  double m_beyond, m_all = 0;  // m
  std::vector<uint8_t> m_isNear;
  std::vector<uint32_t> m_near;
};

/// Pairs of neighbours that structure ties, across blades.
std::vector<Cuts::Pair> pairsAcross(const ParticleStore& store, const Neighbours& neighbours,
                                    const StructureGraph& graph, const Reach& reach) {
  const api::NeighbourView lists = neighbours.view();
  const std::span<const uint32_t> near = reach.near();
  std::vector<std::vector<Cuts::Pair>> found(chunkCount(near.size(), grain::kPairs));
  forChunks(near.size(), grain::kPairs, [&](size_t first, size_t last) {
    for (const uint32_t i : near.subspan(first, last - first)) {
      if (graph.isFree(i)) continue;
      for (uint32_t q = lists.begin[i]; q < lists.last[i]; ++q) {
        const uint32_t j = lists.index[q];
        if (i < j && graph.tied(i, j) && reach.isCut(i, j))
          found[first / grain::kPairs].push_back(Cuts::pairOf(store.id()[i], store.id()[j]));
      }
    }
  });
  std::vector<Cuts::Pair> pairs;
  for (const std::vector<Cuts::Pair>& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  return pairs;
}

}  // namespace

template <class Goes>
void ConstraintSystem::breakTies(Set& set, const ParticleStore& store, CopiedConstraints::Set& copied,
                                 const Goes& goes) {
  Edits edits;
  Sink sink(*this, set, store, edits);
  std::vector<uint32_t> going;
  findIndices(set.count, going,
              [&](size_t k) { return goes(std::span(set.particles).subspan(k * set.arity, set.arity)); });
  for (const uint32_t k : going) {
    copyTie(set, store, k, copied);
    sink.remove(k);
  }
  apply(set, store, edits);
}

TieChange ConstraintSystem::cut(const ParticleStore& store, const Neighbours& neighbours, std::span<const Blade> blades,
                                std::span<const uint8_t> isSpared) {
  const Reach reach(store, blades, isSpared, m_settings.spacing);
  TieChange change;
  if (reach.near().empty()) return change;
  change.cuts = m_cuts.add(pairsAcross(store, neighbours, graph(store.size()), reach));
  CopiedConstraints broken;
  for (Set& set : m_sets) {
    if (!set.structural || set.disabled) continue;
    CopiedConstraints::Set& copied = broken.sets.emplace_back();
    copied.name = set.name;
    breakTies(set, store, copied, [&](std::span<const uint32_t> tied) { return reach.isCut(tied); });
  }
  reshapeGroups(store, neighbours, change.cuts, &broken);
  std::erase_if(broken.sets, [](const CopiedConstraints::Set& s) { return s.id.empty() && s.split.before.empty(); });
  if (!broken.sets.empty()) change.ties = std::make_shared<const CopiedConstraints>(std::move(broken));
  return change;
}

/// Groups fall into pieces, or grow together, where pairs are parted or are no longer; what came of those that are not
/// rigid is noted, since they do not find together by themselves.
void ConstraintSystem::reshapeGroups(const ParticleStore& store, const Neighbours& neighbours,
                                     std::span<const Cuts::Pair> pairs, CopiedConstraints* noted) {
  const bool any = std::any_of(m_sets.begin(), m_sets.end(), [](const Set& s) { return s.groups && !s.disabled; });
  if (pairs.empty() || !any) return;
  std::vector<uint8_t> marked(store.size(), 0);
  for (const Cuts::Pair pair : pairs) {
    for (const uint32_t id : {Cuts::lower(pair), Cuts::higher(pair)}) {
      if (const size_t i = store.indexOf(id); i < store.size()) marked[i] = 1;
    }
  }
  const CutsShown shown(*this, store);
  for (Set& set : m_sets) {
    if (!set.groups || set.disabled) continue;
    set.groups->noteChanges(marked);
    SplitGroups split;
    groupTopology(set, store, neighbours, &split);
    if (noted && !set.rigid && !split.before.empty()) {
      noted->sets.push_back({set.name, {}, {}, {}, std::move(split)});
    }
  }
}

void ConstraintSystem::heal(const ParticleStore& store, const Neighbours& neighbours,
                            std::span<const Cuts::Pair> pairs) {
  Cuts healed;
  healed.add(pairs);
  m_healedView = healed.view(store);
  reshapeGroups(store, neighbours, pairs);
  m_healedView = nullptr;
}

TieChange ConstraintSystem::weld(const ParticleStore& store, const Neighbours& neighbours, std::span<const Blade> balls,
                                 std::span<const uint8_t> isSpared) {
  std::vector<uint8_t> marked(store.size(), 0);
  std::vector<uint32_t> within;
  findIndices(store.size(), within, [&](size_t i) {
    const uint32_t body = store.body()[i];
    if (!api::holds(store.motion()[i]) || (body < isSpared.size() && isSpared[body] != 0)) return false;
    return std::any_of(balls.begin(), balls.end(), [&](const Blade& ball) {
      return fromCentre(store, static_cast<uint32_t>(i), ball).squaredNorm() < ball.radius * ball.radius;
    });
  });
  for (const uint32_t i : within) marked[i] = 1;
  TieChange change;
  change.made = true;
  change.cuts = m_cuts.among(store, marked);
  m_cuts.remove(change.cuts);
  CopiedConstraints made;
  for (Set& set : m_sets) {
    if (!set.structural || set.disabled) continue;
    CopiedConstraints::Set& copied = made.sets.emplace_back();
    copied.name = set.name;
    weldSet(set, store, neighbours, within, copied);
  }
  heal(store, neighbours, change.cuts);
  std::erase_if(made.sets, [](const CopiedConstraints::Set& s) { return s.id.empty(); });
  if (!made.sets.empty()) change.ties = std::make_shared<const CopiedConstraints>(std::move(made));
  return change;
}

void ConstraintSystem::weldSet(Set& set, const ParticleStore& store, const Neighbours& neighbours,
                               std::span<const uint32_t> within, CopiedConstraints::Set& copied) {
  const auto* welding = static_cast<const api::Welding*>(set.plugin->extension(api::kWeldsMatter));
  if (!welding) return;
  std::vector<uint32_t> members;
  std::copy_if(within.begin(), within.end(), std::back_inserter(members), [&](uint32_t i) {
    const uint32_t body = store.body()[i];
    return body < set.used.size() && set.used[body] != 0;
  });
  if (members.empty()) return;
  Edits edits;
  Sink sink(*this, set, store, edits);
  if (!guarded(set, [&] {
        welding->weld(context(set, m_settings.dt, 0, 0), store.view(), neighbours.view(),
                      {members.data(), members.size()}, sink);
      })) {
    return;
  }
  for (const uint32_t i : edits.particles) copied.id.push_back(store.id()[i]);
  copied.values = edits.values;
  apply(set, store, edits);
}

ConstraintSystem::Set* ConstraintSystem::find(const CopiedConstraints::Set& copied) {
  const auto found = std::find_if(m_sets.begin(), m_sets.end(), [&](const Set& s) { return s.name == copied.name; });
  return found == m_sets.end() || found->disabled ? nullptr : &*found;
}

void ConstraintSystem::tie(ParticleStore& store, const Neighbours& neighbours, const TieChange& change) {
  m_cuts.remove(change.cuts);
  if (change.ties) {
    putBack(store, *change.ties);
    for (const CopiedConstraints::Set& copied : change.ties->sets) {
      if (Set* set = find(copied); set && set->groups) set->groups->rejoin(store, copied.split), m_graphValid = false;
    }
  }
  heal(store, neighbours, change.cuts);
}

void ConstraintSystem::sever(const ParticleStore& store, const Neighbours& neighbours, const TieChange& change) {
  m_cuts.add(change.cuts);
  reshapeGroups(store, neighbours, change.cuts);
  if (!change.ties) return;
  for (const CopiedConstraints::Set& copied : change.ties->sets) {
    Set* set = find(copied);
    if (!set || copied.id.empty()) continue;
    KeySet keys;
    std::vector<uint32_t> tied(set->arity);
    for (size_t k = 0; k < copied.id.size(); k += set->arity) {
      for (size_t a = 0; a < set->arity; ++a) tied[a] = static_cast<uint32_t>(store.indexOf(copied.id[k + a]));
      if (std::all_of(tied.begin(), tied.end(), [&](uint32_t i) { return i < store.size(); }))
        keys.insert(keyOf(*set, store, tied.data()));
    }
    CopiedConstraints::Set gone;
    breakTies(*set, store, gone,
              [&](std::span<const uint32_t> each) { return keys.contains(keyOf(*set, store, each.data())); });
  }
}

}  // namespace ps
