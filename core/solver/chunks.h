// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"

#include <functional>

namespace ps {

inline size_t chunkCount(size_t count, size_t grain) { return (count + grain - 1) / grain; }

/// parallelFor without the allocation that a std::function of a large lambda costs: a steady step allocates nothing.
template <class Body>
void forChunks(size_t count, size_t grain, const Body& body) {
  parallelFor(count, grain, std::cref(body));
}

}  // namespace ps
