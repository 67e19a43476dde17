// SPDX-License-Identifier: Apache-2.0
// How rigid bodies melt apart, grow by freezing and grow together, once per frame.
#include "joining.h"
#include "rigidbody.h"
#include "rigidpieces.h"
#include "rigidsplitting.h"
#include "sharedloops.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace ps::constraint {
namespace {

using api::ConstraintContext;
using api::GroupBatch;
using api::Motion;
using api::NeighbourView;
using api::ParticleView;

constexpr uint32_t kNone = ~0u;
/// Faces of two bodies touch a spacing apart, where their lattices do not match with particles up to 1.22 spacings
/// away from each other.
constexpr double kTouchReach = 1.25;
/// Pairs that must touch, and for how long in s, until two bodies are one: a brush in passing does not join them.
constexpr size_t kLeastPairs = 3;
constexpr double kHoldTime = 0.5;
/// What one thread takes for a particle, and for its list, microseconds.
constexpr double kPerParticle = 0.002, kPerList = 0.03;
/// What Joining::freshness() says of a particle that a body has taken, while others may still freeze to it.
constexpr uint8_t kTaken = 2;

class Reshaping {
 public:
  Reshaping(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists, const GroupBatch& all,
            const api::Threads* threads)
      : m_context(context),
        m_threads(threads),
        m_p(p),
        m_lists(lists),
        m_all(all),
        m_joining(context, p),
        m_touch(static_cast<float*>(p.fields->write(kTouchField, api::FieldType::Float32))),
        m_gone(all.count, 0) {
    m_joining.noteFluid(m_threads);
  }

  void run(api::GroupSink& sink) {
    m_pieces = RigidSplitting(m_context, m_p, m_lists, m_all, m_threads).run(m_gone);
    const bool edited = std::any_of(m_all.changed, m_all.changed + m_all.count, [](uint8_t c) { return c != 0; });
    if (edited || m_joining.anybody(m_threads)) {
      m_pieceOf = std::make_unique_for_overwrite<uint32_t[]>(m_p.count);
      forShared(m_threads, m_p.count, kPerParticle, [&](size_t i) { m_pieceOf[i] = kNone; });
      for (uint32_t piece = 0; piece < m_pieces.size(); ++piece) {
        eachKept(m_pieces[piece], [&](size_t, size_t k) { m_pieceOf[m_all.particles[k]] = piece; });
      }
      freeze();
      growTogether();
    }
    for (size_t g = 0; g < m_all.count; ++g) {
      if (m_gone[g] != 0) sink.remove(g);
    }
    for (const RigidPiece& piece : m_pieces) {
      if (piece.changed) emit(piece, sink);
    }
  }

 private:
  size_t least(uint32_t particle) const { return leastMembers(m_context.parametersOf(m_p.body[particle])); }

  /// visit(n, place) for the n-th of the members that are left, by any thread.
  template <class Visit>
  void eachKept(const RigidPiece& piece, const Visit& visit) const {
    if (piece.group == m_all.count) return;
    forShared(m_threads, piece.left(m_all), kPerParticle, [&](size_t n) { visit(n, piece.placeOf(m_all, n)); });
  }

  double squaredDistance(uint32_t i, uint32_t j) const {
    const Vector d = vectorOf(m_p.position[i]) - vectorOf(m_p.position[j]);
    return dot(d, d);
  }
  /// Splitting later must not find a gap where something froze: never farther than its own reach.
  double squaredReach(uint32_t i) const {
    const double reach = std::min(double{m_joining.reach(i)}, kRigidReach * m_context.spacing);
    return reach * reach;
  }

  /// What has frozen joins the piece of its nearest neighbour; what none is near begins a new one.
  void freeze() {
    const std::vector<uint32_t> frozen = findShared(m_threads, m_p.count, kPerParticle, [&](size_t k) {
      const auto i = static_cast<uint32_t>(k);
      const bool free = m_p.motion[i] == Motion::Solid && m_pieceOf[i] == kNone && m_joining.fresh(i);
      return free && m_joining.keeper(i) != Keeper::Bonds && m_joining.frozen(i);
    });
    std::vector<uint32_t> loose, hosts(frozen.size());  // hosts: pieces, as they are before anything joins
    forShared(m_threads, frozen.size(), kPerList, [&](size_t n) {
      const uint32_t nearest = nearestMember(frozen[n]);
      hosts[n] = nearest == kNone ? kNone : m_pieceOf[nearest];
    });
    for (size_t n = 0; n < frozen.size(); ++n) {
      if (hosts[n] != kNone)
        assign(frozen[n], hosts[n]);
      else if (m_joining.keeper(frozen[n]) == Keeper::Rigid)
        loose.push_back(frozen[n]);
    }
    if (loose.size() > 1) begin(loose);
  }
  uint32_t nearestMember(uint32_t i) const {
    uint32_t nearest = kNone;
    double least = squaredReach(i);
    for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
      const uint32_t j = m_lists.index[q];
      if (m_pieceOf[j] == kNone || !m_joining.mayFreeze(i, j)) continue;
      const double d2 = squaredDistance(i, j);
      if (d2 > least || (d2 == least && nearest != kNone && m_p.id[j] > m_p.id[nearest])) continue;
      nearest = j, least = d2;
    }
    return nearest;
  }
  void assign(uint32_t i, uint32_t piece) {
    m_pieces[piece].joined.push_back(i);
    m_pieces[piece].changed = true;
    if (m_pieces[piece].group < m_all.count) m_gone[m_pieces[piece].group] = 1;
    m_pieceOf[i] = piece;
    m_joining.freshness(i) = kTaken;
    if (m_joining.keeper(i) == Keeper::None) m_joining.setKeeper(i, Keeper::Guest);
  }
  void begin(const std::vector<uint32_t>& loose) {
    std::vector<uint32_t> slot(m_p.count, kNone);
    for (uint32_t s = 0; s < loose.size(); ++s) slot[loose[s]] = s;
    DisjointSets sets(loose.size());
    for (uint32_t s = 0; s < loose.size(); ++s) {
      const uint32_t i = loose[s];
      const double reach = squaredReach(i);
      for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
        const uint32_t j = m_lists.index[q];
        if (slot[j] != kNone && m_joining.mayFreeze(i, j) && squaredDistance(i, j) < reach) sets.unite(s, slot[j]);
      }
    }
    for (const std::vector<size_t>& set : sets.sets()) {
      if (set.size() < std::max<size_t>(2, least(loose[set[0]]))) continue;
      m_pieces.push_back({m_all.count, false, {}, {}, true});
      for (const size_t s : set) assign(loose[s], static_cast<uint32_t>(m_pieces.size() - 1));
    }
  }

  /// One of the two was put back by undo: the pieces of its body that it touches were one.
  bool returned(uint32_t i, uint32_t j) const {
    return m_p.body[i] == m_p.body[j] && std::max(m_touch[i], m_touch[j]) >= kReturned;
  }
  /// They were cut apart, and are no more.
  bool healed(uint32_t i, uint32_t j) const { return m_context.healed && m_context.healed->between(i, j); }
  /// How two members of different pieces hold on to each other now.
  enum class Grip { None, Dry, Wet, Healed };
  Grip grip(uint32_t i, uint32_t j) const {
    const double d2 = squaredDistance(i, j), touch = kTouchReach * m_context.spacing;
    if (healed(i, j) && d2 < kRigidReach * kRigidReach * m_context.spacing * m_context.spacing) return Grip::Healed;
    if (returned(i, j) && d2 < squaredReach(i)) return Grip::Wet;
    if (d2 < std::max(squaredReach(i), squaredReach(j)) && m_joining.mayFreeze(i, j)) return Grip::Wet;
    return d2 < touch * touch && m_joining.maySinter(i, j) ? Grip::Dry : Grip::None;
  }
  bool hasOtherNear(uint32_t i) const {
    const uint32_t own = m_pieceOf[i];
    bool other = false;
    for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
      const uint32_t piece = m_pieceOf[m_lists.index[q]];
      other = other || (piece != kNone && piece != own);
    }
    return other;
  }
  /// Particles, and whether they were cut apart and are no more.
  struct Touch {
    uint32_t i, j;
    bool healed;
  };
  /// What a member touches, and what follows from it, which is kept until all have looked.
  void look(uint32_t i, std::vector<Touch>& touching) {
    bool touches = false, wet = false;
    for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
      const uint32_t j = m_lists.index[q];
      if (m_pieceOf[j] == kNone || m_pieceOf[j] == m_pieceOf[i]) continue;
      const Grip g = grip(i, j);
      if (g == Grip::None) continue;
      touches = true;
      wet = wet || g == Grip::Wet;
      if (i < j || g == Grip::Healed) touching.push_back({i, j, g == Grip::Healed});
    }
    m_touched[i] = touches ? m_touch[i] + static_cast<float>(m_context.dt) : 0.0f;
    // Dry by now, once nobody else is near.
    m_drying[i] = m_joining.fresh(i) && !wet ? 1 : 0;
  }
  std::vector<std::vector<Touch>> findTouches() {
    m_touched = std::make_unique_for_overwrite<float[]>(m_p.count);
    m_drying = std::make_unique_for_overwrite<uint8_t[]>(m_p.count);
    std::vector<std::vector<Touch>> found((m_p.count + kSharedAtATime - 1) / kSharedAtATime);
    api::shareAmong(m_threads, m_p.count, kSharedAtATime, kPerList * static_cast<double>(m_p.count),
                    [&](size_t first, size_t last) {
                      std::vector<Touch> own;
                      for (size_t k = first; k < last; ++k) {
                        const auto i = static_cast<uint32_t>(k);
                        if (m_pieceOf[i] == kNone) continue;
                        m_touched[i] = 0;
                        m_drying[i] = m_joining.fresh(i) ? 1 : 0;
                        if (hasOtherNear(i)) look(i, own);
                      }
                      found[first / kSharedAtATime] = std::move(own);
                    });
    return found;
  }
  /// Pieces whose members have touched for long enough become one.
  void growTogether() {
    DisjointSets sets(m_pieces.size());
    std::vector<std::pair<uint32_t, uint32_t>> held;  // pieces
    for (const std::vector<Touch>& some : findTouches()) {
      for (const auto& [i, j, healed] : some) {
        if (healed) sets.unite(m_pieceOf[i], m_pieceOf[j]);
        if (!(i < j) || (!returned(i, j) && std::min(m_touch[i], m_touch[j]) < static_cast<float>(kHoldTime))) continue;
        held.push_back(std::minmax(m_pieceOf[i], m_pieceOf[j]));
      }
    }
    keepTouches();
    std::sort(held.begin(), held.end());
    for (size_t k = 0, next = 0; k < held.size(); k = next) {
      while (next < held.size() && held[next] == held[k]) ++next;
      if (next - k >= kLeastPairs) sets.unite(held[k].first, held[k].second);
    }
    for (uint32_t piece = 0; piece < m_pieces.size(); ++piece) {
      if (const size_t into = sets.find(piece); into != piece) merge(piece, into);
    }
  }
  void keepTouches() {
    forShared(m_threads, m_p.count, kPerParticle, [&](size_t k) {
      const auto i = static_cast<uint32_t>(k);
      if (m_pieceOf[i] == kNone) return;
      m_touch[i] = m_touched[i] < kReturned ? m_touched[i] : 0.0f;
      if (m_drying[i] != 0) m_joining.freshness(i) = 0;
    });
  }
  void merge(uint32_t from, size_t into) {
    RigidPiece &a = m_pieces[into], &b = m_pieces[from];
    for (const RigidPiece* piece : {&a, &b}) {
      if (piece->group < m_all.count) m_gone[piece->group] = 1;
    }
    const size_t before = a.joined.size();
    a.joined.resize(before + (b.group < m_all.count ? b.left(m_all) : 0));
    eachKept(b, [&](size_t n, size_t k) { a.joined[before + n] = m_all.particles[k]; });
    a.joined.insert(a.joined.end(), b.joined.begin(), b.joined.end());
    a.changed = true;
    b = {m_all.count, false, {}, {}, false};
  }

  /// Members keep their velocities, and a body takes its momentum from them: none is lost on the way.
  void emit(const RigidPiece& piece, api::GroupSink& sink) {
    const bool begins = piece.group == m_all.count;
    const size_t left = begins ? 0 : piece.left(m_all);
    m_made.resize(left + piece.joined.size());
    const auto join = [&](const auto& placeOf, double shrunk) {
      forShared(m_threads, piece.joined.size(), kPerParticle, [&](size_t n) {
        const uint32_t i = piece.joined[n];
        m_made.set(left + n, i, placeOf(vectorOf(m_p.position[i])),
                   static_cast<float>(double{m_p.position[i].w} * shrunk));
      });
    };
    if (begins) {
      const Vector origin = vectorOf(m_p.position[piece.joined[0]]);
      join([&](Vector at) { return at - origin; }, 1);
      return m_made.emit(centreOf(m_p, m_made.particles), {}, 1, sink);
    }
    const RigidBody body(m_p, m_all, piece.group, m_threads);
    eachKept(piece, [&](size_t n, size_t k) {
      m_made.set(n, m_all.particles[k], restPlaceOf(m_all, k), m_all.memberValues[RigidModel::kRestVolume][k]);
    });
    const double scale = body.scale();
    join([&](Vector at) { return body.restOf(at); }, 1 / (scale * scale * scale));
    m_made.emit(centreOf(m_p, m_made.particles), body.rotation(), m_all.values[RigidModel::kScale][piece.group], sink);
  }

  const ConstraintContext& m_context;
  const api::Threads* m_threads;
  const ParticleView& m_p;
  const NeighbourView& m_lists;
  const GroupBatch& m_all;
  const Joining m_joining;
  float* m_touch;
  std::vector<uint8_t> m_gone;  ///< groups that do not stay as they are
  std::vector<RigidPiece> m_pieces;
  std::unique_ptr<uint32_t[]> m_pieceOf;  ///< by particle
  std::unique_ptr<uint8_t[]> m_drying;    ///< by member: nobody is left who may freeze to it
  std::unique_ptr<float[]> m_touched;     ///< s, likewise: what m_touch is after this frame
  NewRigidGroup m_made;
};

}  // namespace

void RigidModel::topology(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
                          const GroupBatch& all, api::GroupSink& sink) const {
  Reshaping(context, p, lists, all, m_threads).run(sink);
}

}  // namespace ps::constraint
