// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

// Why one wrapper: results must not depend on the number of threads. Work is cut into chunks of a fixed size, whatever
// the number of threads; a chunk writes only its own elements, and sums are kept per chunk and added in chunk order.
// oneTBB runs the chunks; under ThreadSanitizer, where TBB drowns real races in false ones, plain threads do.
namespace ps {

/// Threads used by parallelFor from now on, in the whole process; 0: one per core. Not while a loop runs.
void setThreadCount(int count);
int threadCount();

/// Calls body(first, last) for consecutive chunks of `grain` elements that cover [0, count).
/// What a body throws reaches the caller, once all running chunks have ended.
void parallelFor(size_t count, size_t grain, const std::function<void(size_t first, size_t last)>& body);

/// Sum over chunks of body(first, last), added in chunk order: the same bits for any number of threads.
double parallelSum(size_t count, size_t grain, const std::function<double(size_t first, size_t last)>& body);

inline size_t chunkCount(size_t count, size_t grain) { return (count + grain - 1) / grain; }

/// parallelFor without the allocation that a std::function of a large lambda costs: a steady step allocates nothing.
template <class Body>
void forChunks(size_t count, size_t grain, const Body& body) {
  parallelFor(count, grain, std::cref(body));
}

}  // namespace ps
