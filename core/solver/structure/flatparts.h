// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <span>

namespace ps {

/// Lists one after the other, of which `begin` says where each begins, and where the last one ends: visit(list, from,
/// to) for what of the places [first, last) lies within each of them, counted from its own begin. For loops over all
/// places, cut into chunks of one size however long the lists are.
template <class Visit>
void eachFlatPart(std::span<const size_t> begin, size_t first, size_t last, const Visit& visit) {
  size_t list = static_cast<size_t>(std::upper_bound(begin.begin(), begin.end(), first) - begin.begin()) - 1;
  for (; first < last; ++list) {
    const size_t end = std::min(last, begin[list + 1]);
    if (first < end) visit(list, first - begin[list], end - begin[list]);
    first = std::max(first, end);
  }
}

}  // namespace ps
