// SPDX-License-Identifier: Apache-2.0
// How rigid bodies melt apart, grow by freezing and grow together, once per frame.
#include "joining.h"
#include "rigidbody.h"
#include "rigidpieces.h"

#include <algorithm>
#include <functional>
#include <limits>
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
constexpr size_t kNowhere = ~size_t{0};
/// Faces of two bodies touch a spacing apart, where their lattices do not match with particles up to 1.22 spacings
/// away from each other.
constexpr double kTouchReach = 1.25;
/// Pairs that must touch, and for how long in s, until two bodies are one: a brush in passing does not join them.
constexpr size_t kLeastPairs = 3;
constexpr double kHoldTime = 0.5;
/// Members around a lump that has melted out of a body, beyond which all of the body is looked at as soon.
constexpr size_t kMostRim = 256;
/// Particles of a chunk that looks at their lists, and what one takes.
constexpr size_t kSharedParticles = 1024;
constexpr double kMicrosecondsPerList = 0.03;
/// What Joining::freshness() says of a particle that a body has taken, while others may still freeze to it.
constexpr uint8_t kTaken = 2;

/// A body in the making: places of a group's members that are left, and particles that have come to them.
struct Piece {
  size_t group = 0;          ///< of the batch; its count for a piece that begins
  bool whole = false;        ///< all members of the group are left, and not listed
  std::vector<size_t> kept;  ///< else those that are
  std::vector<uint32_t> joined;
  bool changed = false;
};

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
    for (size_t g = 0; g < m_all.count; ++g) split(g);
    const bool edited = std::any_of(m_all.changed, m_all.changed + m_all.count, [](uint8_t c) { return c != 0; });
    if (edited || m_joining.anybody(m_threads)) {
      m_pieceOf.assign(m_p.count, kNone);
      for (uint32_t piece = 0; piece < m_pieces.size(); ++piece) {
        forKept(m_pieces[piece], [&](size_t k) { m_pieceOf[m_all.particles[k]] = piece; });
      }
      freeze();
      growTogether();
    }
    for (size_t g = 0; g < m_all.count; ++g) {
      if (m_gone[g] != 0) sink.remove(g);
    }
    for (const Piece& piece : m_pieces) {
      if (piece.changed) emit(piece, sink);
    }
  }

 private:
  size_t least(uint32_t particle) const { return leastMembers(m_context.parametersOf(m_p.body[particle])); }

  template <class Visit>
  void forKept(const Piece& piece, Visit&& visit) const {
    if (piece.whole) {
      for (size_t k = m_all.begin[piece.group]; k < m_all.begin[piece.group + 1]; ++k) visit(k);
    }
    for (const size_t k : piece.kept) visit(k);
  }

  /// Members that have melted leave; what is left falls into what hangs together.
  void split(size_t g) {
    const size_t first = m_all.begin[g], last = m_all.begin[g + 1], before = last - first;
    size_t solid = 0;
    for (size_t k = first; k < last; ++k) solid += melted(k) ? 0 : 1;
    if (solid == before && m_all.changed[g] == 0) {
      m_pieces.push_back({g, true, {}, {}, false});
      return;
    }
    std::vector<size_t> kept;
    kept.reserve(solid);
    for (size_t k = first; k < last; ++k) {
      if (!melted(k)) kept.push_back(k);
    }
    const size_t fewest = least(m_all.particles[m_all.begin[g]]);
    if (m_all.changed[g] == 0 && kept.size() >= fewest && staysWhole(g)) {
      m_gone[g] = 1;
      m_pieces.push_back({g, false, std::move(kept), {}, true});
      return;
    }
    std::vector<Vector> rest;
    rest.reserve(kept.size());
    for (const size_t k : kept) rest.push_back(restPlace(k));
    std::function<bool(size_t, size_t)> parted;
    if (m_context.cuts) parted = [&](size_t a, size_t b) { return isCut(kept[a], kept[b]); };
    const std::vector<std::vector<size_t>> pieces = piecesOf(rest, kRigidReach * m_context.spacing, parted);
    const bool whole = pieces.size() == 1 && kept.size() == before && before >= fewest;
    m_gone[g] = whole ? 0 : 1;
    for (const std::vector<size_t>& members : pieces) {
      if (members.size() < fewest) continue;
      Piece piece{g, false, {}, {}, !whole};
      for (const size_t member : members) piece.kept.push_back(kept[member]);
      m_pieces.push_back(std::move(piece));
    }
  }

  Vector restPlace(size_t k) const {
    return {m_all.memberValues[RigidModel::kRestX][k], m_all.memberValues[RigidModel::kRestY][k],
            m_all.memberValues[RigidModel::kRestZ][k]};
  }
  bool isCut(size_t k, size_t other) const {
    return m_context.cuts && m_context.cuts->between(m_all.particles[k], m_all.particles[other]);
  }
  bool hangTogether(size_t k, size_t other) const {
    const Vector d = restPlace(k) - restPlace(other);
    const double reach = kRigidReach * m_context.spacing;
    return dot(d, d) < reach * reach && !isCut(k, other);
  }
  /// Whether a body that has hung together still does without those that have melted, told by what is near them alone:
  /// it does when all that each lump of them touched hangs together directly. False where that does not tell.
  bool staysWhole(size_t g) {
    const double scale = std::max(1.0, double{m_all.values[RigidModel::kScale][g]});
    if (!(double{m_lists.searchRadius} > scale * kRigidReach * m_context.spacing)) return false;
    const size_t first = m_all.begin[g], last = m_all.begin[g + 1];
    m_placeOf.assign(m_p.count, kNowhere);
    for (size_t k = first; k < last; ++k) m_placeOf[m_all.particles[k]] = k;
    m_followed.assign(last - first, 0);
    for (size_t k = first; k < last; ++k) {
      if (melted(k) && m_followed[k - first] == 0 && !rimHangsTogether(k, first)) return false;
    }
    return true;
  }
  bool melted(size_t k) const { return m_p.motion[m_all.particles[k]] != Motion::Solid; }
  /// visit(place) for members of the group that hung together with the one at place k.
  template <class Visit>
  void forHanging(size_t k, Visit&& visit) const {
    const uint32_t i = m_all.particles[k];
    for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
      const size_t other = m_placeOf[m_lists.index[q]];
      if (other != kNowhere && hangTogether(k, other)) visit(other);
    }
  }
  /// The lump of melted members that the one at place k belongs to; marks all of it.
  bool rimHangsTogether(size_t k, size_t first) {
    std::vector<size_t> open{k}, rim;
    m_followed[k - first] = 1;
    while (!open.empty()) {
      const size_t at = open.back();
      open.pop_back();
      forHanging(at, [&](size_t other) {
        if (std::exchange(m_followed[other - first], uint8_t{1}) == 0) (melted(other) ? open : rim).push_back(other);
      });
    }
    for (const size_t r : rim) m_followed[r - first] = 0;  // another lump may touch it too
    if (rim.size() > kMostRim) return false;
    DisjointSets sets(rim.size());
    for (size_t a = 0; a < rim.size(); ++a) {
      for (size_t b = a + 1; b < rim.size(); ++b) {
        if (hangTogether(rim[a], rim[b])) sets.unite(a, b);
      }
    }
    return sets.sets().size() == 1;
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
    std::vector<uint32_t> loose;
    std::vector<std::pair<uint32_t, uint32_t>> joins;
    for (uint32_t i = 0; i < m_p.count; ++i) {
      const bool free = m_p.motion[i] == Motion::Solid && m_pieceOf[i] == kNone && m_joining.fresh(i);
      if (!free || m_joining.keeper(i) == Keeper::Bonds || !m_joining.frozen(i)) continue;
      const uint32_t host = nearestMember(i);
      if (host != kNone)
        joins.emplace_back(i, m_pieceOf[host]);
      else if (m_joining.keeper(i) == Keeper::Rigid)
        loose.push_back(i);
    }
    for (const auto& [i, piece] : joins) assign(i, piece);
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
  /// Members that have one of another piece in their list.
  std::vector<uint8_t> findBorders() const {
    std::vector<uint8_t> border(m_p.count, 0);
    api::shareAmong(m_threads, m_p.count, kSharedParticles, kMicrosecondsPerList * static_cast<double>(m_p.count),
                    [&](size_t first, size_t last) {
                      for (size_t i = first; i < last; ++i) {
                        const uint32_t own = m_pieceOf[i];
                        if (own == kNone) continue;
                        bool other = false;
                        for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
                          const uint32_t piece = m_pieceOf[m_lists.index[q]];
                          other = other || (piece != kNone && piece != own);
                        }
                        border[i] = other ? 1 : 0;
                      }
                    });
    return border;
  }
  /// Pieces whose members have touched for long enough become one.
  void growTogether() {
    std::vector<std::pair<uint32_t, uint32_t>> touching;  // particles
    DisjointSets sets(m_pieces.size());
    const std::vector<uint8_t> border = findBorders();
    for (uint32_t i = 0; i < m_p.count; ++i) {
      if (m_pieceOf[i] == kNone) continue;
      bool touches = false, wet = false;
      for (uint32_t q = m_lists.begin[i]; border[i] != 0 && q < m_lists.last[i]; ++q) {
        const uint32_t j = m_lists.index[q];
        if (m_pieceOf[j] == kNone || m_pieceOf[j] == m_pieceOf[i]) continue;
        const Grip g = grip(i, j);
        if (g == Grip::None) continue;
        if (g == Grip::Healed) sets.unite(m_pieceOf[i], m_pieceOf[j]);
        touches = true;
        wet = wet || g == Grip::Wet;
        if (i < j) touching.emplace_back(i, j);
      }
      m_touched.push_back(touches ? m_touch[i] + static_cast<float>(m_context.dt) : 0.0f);
      // Dry by now, once nobody else is near.
      m_drying.push_back(m_joining.fresh(i) && !wet ? 1 : 0);
    }
    std::vector<std::pair<uint32_t, uint32_t>> held;  // pieces
    for (const auto& [i, j] : touching) {
      if (!returned(i, j) && std::min(m_touch[i], m_touch[j]) < static_cast<float>(kHoldTime)) continue;
      held.push_back(std::minmax(m_pieceOf[i], m_pieceOf[j]));
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
    size_t k = 0;
    for (uint32_t i = 0; i < m_p.count; ++i) {
      if (m_pieceOf[i] == kNone) continue;
      m_touch[i] = m_touched[k] < kReturned ? m_touched[k] : 0.0f;
      if (m_drying[k++] != 0) m_joining.freshness(i) = 0;
    }
  }
  void merge(uint32_t from, size_t into) {
    Piece &a = m_pieces[into], &b = m_pieces[from];
    for (const Piece* piece : {&a, &b}) {
      if (piece->group < m_all.count) m_gone[piece->group] = 1;
    }
    forKept(b, [&](size_t k) { a.joined.push_back(m_all.particles[k]); });
    a.joined.insert(a.joined.end(), b.joined.begin(), b.joined.end());
    a.changed = true;
    b = {m_all.count, false, {}, {}, false};
  }

  /// Members keep their velocities, and a body takes its momentum from them: none is lost on the way.
  void emit(const Piece& piece, api::GroupSink& sink) const {
    NewRigidGroup group;
    if (piece.group == m_all.count) {
      const Vector origin = vectorOf(m_p.position[piece.joined[0]]);
      for (const uint32_t i : piece.joined) group.add(i, vectorOf(m_p.position[i]) - origin, m_p.position[i].w);
      group.emit(centreOf(m_p, group.particles), {}, 1, sink);
      return;
    }
    const RigidBody body(m_p, m_all, piece.group, m_threads);
    forKept(piece, [&](size_t k) {
      group.add(m_all.particles[k], restPlace(k), m_all.memberValues[RigidModel::kRestVolume][k]);
    });
    const double scale = body.scale(), shrunk = 1 / (scale * scale * scale);
    for (const uint32_t i : piece.joined) {
      group.add(i, body.restOf(vectorOf(m_p.position[i])), static_cast<float>(double{m_p.position[i].w} * shrunk));
    }
    group.emit(centreOf(m_p, group.particles), body.rotation(), m_all.values[RigidModel::kScale][piece.group], sink);
  }

  const ConstraintContext& m_context;
  const api::Threads* m_threads;
  const ParticleView& m_p;
  const NeighbourView& m_lists;
  const GroupBatch& m_all;
  const Joining m_joining;
  float* m_touch;
  std::vector<uint8_t> m_gone;  ///< groups that do not stay as they are
  std::vector<Piece> m_pieces;
  std::vector<size_t> m_placeOf;    ///< of particles in the group that is split
  std::vector<uint8_t> m_followed;  ///< of its members
  std::vector<uint32_t> m_pieceOf;  ///< by particle
  std::vector<uint8_t> m_drying;    ///< of members, in order: nobody is left who may freeze to it
  std::vector<float> m_touched;     ///< s, likewise: what m_touch is after this frame
};

}  // namespace

void RigidModel::topology(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
                          const GroupBatch& all, api::GroupSink& sink) const {
  Reshaping(context, p, lists, all, m_threads).run(sink);
}

}  // namespace ps::constraint
