// SPDX-License-Identifier: Apache-2.0
#include "rigidpieces.h"

#include "sharedloops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace ps::constraint {
namespace {

/// What one thread takes, microseconds.
constexpr double kMicrosecondsPerPoint = 0.004, kMicrosecondsPerCell = 0.05;
/// Cells of which a thread looks at all pairs at a time.
constexpr size_t kSharedCells = 256;

}  // namespace

DisjointSets::DisjointSets(size_t count) : m_parent(count) {
  for (size_t k = 0; k < count; ++k) m_parent[k] = k;
}

size_t DisjointSets::find(size_t k) {
  while (m_parent[k] != k) k = m_parent[k] = m_parent[m_parent[k]];
  return k;
}

void DisjointSets::unite(size_t a, size_t b) {
  a = find(a), b = find(b);
  m_parent[std::max(a, b)] = std::min(a, b);
}

std::vector<std::vector<size_t>> DisjointSets::sets() {
  std::vector<std::vector<size_t>> result;
  std::vector<size_t> place(m_parent.size());
  for (size_t k = 0; k < m_parent.size(); ++k) {
    const size_t least = find(k);
    if (least == k) {
      place[k] = result.size();
      result.emplace_back();
    }
    result[place[least]].push_back(k);
  }
  return result;
}

SharedSets::SharedSets(size_t count, const api::Threads* threads) : m_threads(threads), m_parent(count) {
  std::iota(m_parent.begin(), m_parent.end(), 0u);
}

/// Whom an element knows may be replaced by whom that one knows at any time: it only becomes lower.
uint32_t SharedSets::find(uint32_t k) {
  for (uint32_t above = parent(k).load(std::memory_order_relaxed); above != k;) {
    const uint32_t next = parent(above).load(std::memory_order_relaxed);
    if (next != above) parent(k).store(next, std::memory_order_relaxed);
    k = above, above = next;
  }
  return k;
}

void SharedSets::unite(uint32_t a, uint32_t b) {
  for (;;) {
    a = find(a), b = find(b);
    if (a == b) return;
    if (a < b) std::swap(a, b);
    uint32_t alone = a;  // else somebody has just united it
    if (parent(a).compare_exchange_strong(alone, b, std::memory_order_relaxed)) return;
  }
}

std::vector<std::vector<size_t>> SharedSets::sets() {
  const size_t count = m_parent.size();
  std::vector<uint32_t> least(count), place(count);
  forShared(m_threads, count, kMicrosecondsPerPoint, [&](size_t k) { least[k] = find(static_cast<uint32_t>(k)); });
  std::vector<size_t> sizes;
  for (size_t k = 0; k < count; ++k) {
    if (least[k] == k) place[k] = static_cast<uint32_t>(sizes.size()), sizes.push_back(0);
    ++sizes[place[least[k]]];
  }
  std::vector<std::vector<size_t>> result(sizes.size());
  for (size_t s = 0; s < sizes.size(); ++s) result[s].reserve(sizes[s]);
  for (size_t k = 0; k < count; ++k) result[place[least[k]]].push_back(k);
  return result;
}

namespace {

/// Points in cells no smaller than a radius, so that all within it of a point lie in its cell and those around. Cells
/// grow until there are no more than some for each point: what lies scattered is few to a cell anyway.
class PointCells {
 public:
  PointCells(const std::vector<Vector>& points, double radius, const api::Threads* threads) : m_threads(threads) {
    const auto [low, high] = boundsOf(points);
    const double most = 4 * static_cast<double>(points.size()) + 64;
    const auto along = [](double size, double edge) { return std::floor(size / edge) + 1; };
    double edge = radius;
    for (;; edge *= 2) {
      const double n[] = {along(high.x - low.x, edge), along(high.y - low.y, edge), along(high.z - low.z, edge)};
      if (n[0] * n[1] * n[2] > most) continue;
      for (size_t a = 0; a < 3; ++a) m_count[a] = static_cast<size_t>(n[a]);
      break;
    }
    m_begin.assign(m_count[0] * m_count[1] * m_count[2] + 1, 0);
    std::vector<uint32_t> cell(points.size());
    forShared(threads, points.size(), kMicrosecondsPerPoint, [&, from = low](size_t k) {
      const Vector d = points[k] - from;
      const auto place = [&](double c, size_t a) { return std::min(static_cast<size_t>(c / edge), m_count[a] - 1); };
      cell[k] = static_cast<uint32_t>((place(d.z, 2) * m_count[1] + place(d.y, 1)) * m_count[0] + place(d.x, 0));
      addOne(m_begin[cell[k] + size_t{1}]);
    });
    sumUpShared(threads, m_begin, kMicrosecondsPerPoint);
    m_order.resize(points.size());
    std::vector<uint32_t> next(m_begin.begin(), m_begin.end() - 1);
    // In no order within a cell: who hangs together does not depend on it.
    forShared(threads, points.size(), kMicrosecondsPerPoint,
              [&](size_t k) { m_order[addOne(next[cell[k]])] = static_cast<uint32_t>(k); });
  }

  /// visit(a, b) for each pair that may be within the radius, once, by any thread.
  template <class Visit>
  void forPairs(const Visit& visit) const {
    const size_t cells = m_begin.size() - 1;
    api::shareAmong(m_threads, cells, kSharedCells, kMicrosecondsPerCell * static_cast<double>(cells),
                    [&](size_t first, size_t last) {
                      for (size_t cell = first; cell < last; ++cell) {
                        if (m_begin[cell] == m_begin[cell + 1]) continue;
                        const size_t row = cell / m_count[0];
                        forPairsOf(cell % m_count[0], row % m_count[1], row / m_count[1], cell, visit);
                      }
                    });
  }

 private:
  std::pair<Vector, Vector> boundsOf(const std::vector<Vector>& points) const {
    struct Bounds {
      Vector low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
      void include(const Vector& from, const Vector& to) {
        low = {std::min(low.x, from.x), std::min(low.y, from.y), std::min(low.z, from.z)};
        high = {std::max(high.x, to.x), std::max(high.y, to.y), std::max(high.z, to.z)};
      }
    };
    std::vector<Bounds> parts((points.size() + kSharedAtATime - 1) / kSharedAtATime);
    api::shareAmong(m_threads, points.size(), kSharedAtATime,
                    kMicrosecondsPerPoint * static_cast<double>(points.size()), [&](size_t first, size_t last) {
                      Bounds own;
                      for (size_t k = first; k < last; ++k) own.include(points[k], points[k]);
                      parts[first / kSharedAtATime] = own;
                    });
    Bounds all;
    for (const Bounds& part : parts) all.include(part.low, part.high);
    return {all.low, all.high};
  }

  /// Those of a cell with each other, and with those of the 13 cells that come after it.
  template <class Visit>
  void forPairsOf(size_t x, size_t y, size_t z, size_t cell, const Visit& visit) const {
    const size_t nx = m_count[0], plane = nx * m_count[1];
    const size_t left = x > 0 ? 1 : 0, right = x + 1 < nx ? 1 : 0;
    const auto row = [&](size_t middle) { run(cell, m_begin[middle - left], m_begin[middle + right + 1], visit); };
    for (uint32_t a = m_begin[cell]; a < m_begin[cell + 1]; ++a) {
      for (uint32_t b = a + 1; b < m_begin[cell + 1 + right]; ++b) visit(m_order[a], m_order[b]);
    }
    if (y + 1 < m_count[1]) row(cell + nx);
    if (z + 1 == m_count[2]) return;
    if (y > 0) row(cell + plane - nx);
    row(cell + plane);
    if (y + 1 < m_count[1]) row(cell + plane + nx);
  }
  template <class Visit>
  void run(size_t cell, uint32_t first, uint32_t last, const Visit& visit) const {
    for (uint32_t a = m_begin[cell]; a < m_begin[cell + 1]; ++a) {
      for (uint32_t b = first; b < last; ++b) visit(m_order[a], m_order[b]);
    }
  }

  const api::Threads* m_threads;
  std::array<size_t, 3> m_count{};
  std::vector<uint32_t> m_begin, m_order;
};

}  // namespace

std::vector<std::vector<size_t>> piecesOf(const std::vector<Vector>& points, double radius,
                                          const std::function<bool(size_t, size_t)>& parted,
                                          const api::Threads* threads) {
  if (points.empty()) return {};
  SharedSets sets(points.size(), threads);
  PointCells(points, radius, threads).forPairs([&](uint32_t a, uint32_t b) {
    const Vector d = points[a] - points[b];
    if (dot(d, d) < radius * radius && !(parted && parted(a, b))) sets.unite(a, b);
  });
  return sets.sets();
}

}  // namespace ps::constraint
