// SPDX-License-Identifier: Apache-2.0
// Why so many loops: a body may have all particles of a scene as its members, and loses some of them in each frame. Who
// leaves, what they touched and what hangs together is found by all threads; one thread only puts the answers in order.
#include "rigidsplitting.h"

#include "rigidbody.h"
#include "rigidpieces.h"
#include "sharedloops.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace ps::constraint {
namespace {

constexpr uint32_t kNowhere = ~0u;
/// Members around a lump that has melted out of a body, beyond which all of the body is looked at as soon.
constexpr size_t kMostRim = 256;
/// Lumps, and lists of neighbours, that a thread takes at a time.
constexpr size_t kSharedLumps = 4, kSharedLists = 16;
/// What one thread takes for a member, for its neighbours, and for those around a lump, microseconds.
constexpr double kPerMember = 0.002, kPerList = 0.3, kPerLump = 5;

}  // namespace

std::vector<RigidPiece> RigidSplitting::run(std::vector<uint8_t>& gone) {
  std::vector<RigidPiece> pieces;
  pieces.reserve(m_all.count);
  const size_t begin = m_all.count > 0 ? m_all.begin[0] : 0, end = m_all.count > 0 ? m_all.begin[m_all.count] : 0;
  std::vector<uint32_t> melted =
      findShared(m_threads, end - begin, kPerMember, [&](size_t k) { return isMelted(begin + k); });
  for (uint32_t& k : melted) k += static_cast<uint32_t>(begin);
  size_t next = 0;
  for (size_t g = 0; g < m_all.count; ++g) {
    const size_t from = next;
    while (next < melted.size() && melted[next] < m_all.begin[g + 1]) ++next;
    if (next == from && m_all.changed[g] == 0)
      pieces.push_back({g, true, {}, {}, false});
    else
      split(g, std::span(melted).subspan(from, next - from), pieces, gone);
  }
  return pieces;
}

std::vector<uint32_t> RigidSplitting::placesBut(size_t first, size_t last, std::span<const uint32_t> melted) const {
  std::vector<uint32_t> kept(last - first - melted.size());
  auto to = kept.begin();
  size_t from = first;
  const auto listUpTo = [&](size_t end) {
    const auto behind = to + static_cast<std::ptrdiff_t>(end - from);
    std::iota(to, behind, static_cast<uint32_t>(from));
    to = behind;
  };
  for (const uint32_t k : melted) {
    listUpTo(k);
    from = k + size_t{1};
  }
  listUpTo(last);
  return kept;
}

void RigidSplitting::split(size_t g, std::span<const uint32_t> melted, std::vector<RigidPiece>& pieces,
                           std::vector<uint8_t>& gone) {
  const size_t first = m_all.begin[g], last = m_all.begin[g + 1], before = last - first;
  std::vector<uint32_t> kept = placesBut(first, last, melted);
  const size_t fewest = leastMembers(m_context.parametersOf(m_p.body[m_all.particles[first]]));
  if (m_all.changed[g] == 0 && kept.size() >= fewest && staysWhole(g, melted)) {
    gone[g] = 1;
    pieces.push_back({g, false, std::move(kept), {}, true});
    return;
  }
  std::vector<Vector> rest(kept.size());
  forShared(m_threads, kept.size(), kPerMember, [&](size_t n) { rest[n] = restPlaceOf(m_all, kept[n]); });
  std::function<bool(size_t, size_t)> parted;
  if (m_context.cuts) parted = [&](size_t a, size_t b) { return isCut(kept[a], kept[b]); };
  const std::vector<std::vector<size_t>> found = piecesOf(rest, kRigidReach * m_context.spacing, parted, m_threads);
  const bool whole = found.size() == 1 && kept.size() == before && before >= fewest;
  gone[g] = whole ? 0 : 1;
  for (const std::vector<size_t>& members : found) {
    if (members.size() < fewest) continue;
    RigidPiece& piece = pieces.emplace_back(RigidPiece{g, false, {}, {}, !whole});
    if (members.size() == kept.size()) {
      piece.kept = std::move(kept);
      return;
    }
    piece.kept.resize(members.size());
    forShared(m_threads, members.size(), kPerMember, [&](size_t n) { piece.kept[n] = kept[members[n]]; });
  }
}

bool RigidSplitting::hangTogether(size_t k, size_t other) const {
  const Vector d = restPlaceOf(m_all, k) - restPlaceOf(m_all, other);
  const double reach = kRigidReach * m_context.spacing;
  return dot(d, d) < reach * reach && !isCut(k, other);
}

/// visit(place) for members of the group that hung together with the one at place k.
template <class Visit>
void RigidSplitting::forHanging(size_t k, const Visit& visit) const {
  const uint32_t i = m_all.particles[k];
  for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
    const uint32_t other = m_placeOf[m_lists.index[q]];
    if (other != kNowhere && hangTogether(k, other)) visit(other);
  }
}

/// Whether a body that has hung together still does without those that have melted, told by what is near them alone: it
/// does when all that each lump of them touched hangs together directly. False where that does not tell.
bool RigidSplitting::staysWhole(size_t g, std::span<const uint32_t> melted) {
  const double scale = std::max(1.0, double{m_all.values[RigidModel::kScale][g]});
  if (!(double{m_lists.searchRadius} > scale * kRigidReach * m_context.spacing)) return false;
  const size_t first = m_all.begin[g], members = m_all.begin[g + 1] - first;
  if (m_placeOf.empty()) m_placeOf.assign(m_p.count, kNowhere);
  forShared(m_threads, members, kPerMember,
            [&](size_t k) { m_placeOf[m_all.particles[first + k]] = static_cast<uint32_t>(first + k); });
  const bool stays = rimsHangTogether(melted);
  forShared(m_threads, members, kPerMember, [&](size_t k) { m_placeOf[m_all.particles[first + k]] = kNowhere; });
  return stays;
}

bool RigidSplitting::rimsHangTogether(std::span<const uint32_t> melted) const {
  std::vector<uint32_t> places;
  const std::vector<Lump> lumps = gatherLumps(melted, places);
  std::atomic<bool> all{true};
  api::shareAmong(
      m_threads, lumps.size(), kSharedLumps, kPerLump * static_cast<double>(lumps.size()), [&](size_t from, size_t to) {
        for (size_t l = from; l < to && all.load(std::memory_order_relaxed); ++l) {
          const std::span<const uint32_t> lump(places.data() + lumps[l].first, lumps[l].last - lumps[l].first);
          if (!rimHangsTogether(lump)) all.store(false, std::memory_order_relaxed);
        }
      });
  return all;
}

std::vector<RigidSplitting::Lump> RigidSplitting::gatherLumps(std::span<const uint32_t> melted,
                                                              std::vector<uint32_t>& places) const {
  SharedSets sets(melted.size(), m_threads);
  forShared(
      m_threads, melted.size(), kPerList,
      [&](size_t n) {
        forHanging(melted[n], [&](size_t other) {
          const auto found = std::lower_bound(melted.begin(), melted.end(), static_cast<uint32_t>(other));
          if (found != melted.end() && *found == other)
            sets.unite(static_cast<uint32_t>(n), static_cast<uint32_t>(found - melted.begin()));
        });
      },
      kSharedLists);
  std::vector<Lump> lumps;
  places.reserve(melted.size());
  for (const std::vector<size_t>& set : sets.sets()) {
    const size_t first = places.size();
    for (const size_t n : set) places.push_back(melted[n]);
    lumps.push_back({first, places.size()});
  }
  return lumps;
}

bool RigidSplitting::rimHangsTogether(std::span<const uint32_t> lump) const {
  std::vector<uint32_t> rim;
  const auto tooMany = [&] {
    std::sort(rim.begin(), rim.end());
    rim.erase(std::unique(rim.begin(), rim.end()), rim.end());
    return rim.size() > kMostRim;
  };
  for (const uint32_t k : lump) {
    forHanging(k, [&](size_t other) {
      if (!isMelted(other)) rim.push_back(static_cast<uint32_t>(other));
    });
    if (rim.size() > 8 * kMostRim && tooMany()) return false;
  }
  if (tooMany()) return false;
  DisjointSets sets(rim.size());
  for (size_t a = 0; a < rim.size(); ++a) {
    for (size_t b = a + 1; b < rim.size(); ++b) {
      if (hangTogether(rim[a], rim[b])) sets.unite(a, b);
    }
  }
  return sets.sets().size() == 1;
}

}  // namespace ps::constraint
