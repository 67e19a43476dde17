// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// What the standard library does to whole arrays, by many threads: of a hundred thousand particles one thread takes
// longer for a dozen such arrays than all threads for the rest of new lists.
namespace ps {

/// As values.assign(count, value).
template <class T>
void assignAll(std::vector<T>& values, size_t count, const T& value) {
  values.resize(count);
  forChunks(count, grain::kNumbers,
            [&](size_t first, size_t last) { std::fill(values.data() + first, values.data() + last, value); });
}

/// As values.assign(from.begin(), from.end()).
template <class T>
void assignAll(std::vector<T>& values, std::span<const T> from) {
  values.resize(from.size());
  forChunks(from.size(), grain::kNumbers, [&](size_t first, size_t last) {
    std::copy(from.data() + first, from.data() + last, values.data() + first);
  });
}

/// As values.assign(), with `one` and then `other`.
template <class T>
void assignBoth(std::vector<T>& values, std::span<const T> one, std::span<const T> other) {
  values.resize(one.size() + other.size());
  forChunks(values.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) values[k] = k < one.size() ? one[k] : other[k - one.size()];
  });
}

/// Each number becomes the sum of all up to it; `sums` is room for one of each chunk.
inline void sumUp(std::span<uint32_t> numbers, std::vector<uint32_t>& sums) {
  const size_t count = numbers.size();
  sums.assign(chunkCount(count, grain::kNumbers), 0);
  forChunks(count, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first + 1; k < last; ++k) numbers[k] += numbers[k - 1];
    sums[first / grain::kNumbers] = numbers[last - 1];
  });
  uint32_t before = 0;
  for (uint32_t& sum : sums) {
    const uint32_t own = sum;
    sum = before;
    before += own;
  }
  forChunks(count, grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) numbers[k] += sums[first / grain::kNumbers];
  });
}

}  // namespace ps
