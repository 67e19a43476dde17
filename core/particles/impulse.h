// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"
#include "core/math/vector.h"

#include <vector>

namespace ps {

/// Sum of vectors of a loop over chunks: one partial sum per chunk, added in order, so that threads have no part in it.
/// Each has a cache line of its own: threads that add at once would wait for each other's.
class ChunkSum {
 public:
  void start(size_t chunks) { m_partial.assign(chunks, {}); }
  void add(size_t chunk, double factor, const Vector3& v) { m_partial[chunk].sum += factor * v; }
  Vector3 total() const {
    Vector3 sum;
    for (const Partial& p : m_partial) sum += p.sum;
    return sum;
  }

 private:
  struct alignas(64) Partial {
    Vector3 sum;
  };
  std::vector<Partial> m_partial;
};

/// Sum over chunks of body(first, last), a Vector3, by partial sums in `partial`.
template <class Body>
Vector3 sumOfChunks(ChunkSum& partial, size_t count, size_t grain, const Body& body) {
  partial.start(chunkCount(count, grain));
  forChunks(count, grain, [&](size_t first, size_t last) { partial.add(first / grain, 1, body(first, last)); });
  return partial.total();
}

/// Impulse that something outside moving matter (a wall, fixed particles) gave to it since the last drain(), kg m/s.
class ExternalImpulse {
 public:
  void add(const Vector3& v) { m_sum += v; }
  Vector3 drain() {
    const Vector3 sum = m_sum;
    m_sum = {};
    return sum;
  }

 private:
  Vector3 m_sum;
};

}  // namespace ps
