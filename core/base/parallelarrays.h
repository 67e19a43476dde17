// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// What the standard library does to whole arrays, by many threads: of a hundred thousand particles one thread takes
// longer for a dozen such arrays than all threads for the rest of new lists.
namespace ps {

/// Makes it as long as that. What it held is lost where there was no room; resize() would copy it, and take twice as
/// much.
template <class T>
void lengthen(std::vector<T>& values, size_t count, size_t spare = 0) {
  if (count > values.capacity()) {
    std::vector<T>().swap(values);
    values.reserve(count + spare);
  }
  values.resize(count);
}

/// As values.assign(count, value).
template <class T>
void assignAll(std::vector<T>& values, size_t count, const T& value) {
  lengthen(values, count);
  forChunks(count, grain::kNumbers,
            [&](size_t first, size_t last) { std::fill(values.data() + first, values.data() + last, value); });
}

/// As values.assign(from.begin(), from.end()).
template <class T>
void assignAll(std::vector<T>& values, std::span<const T> from) {
  lengthen(values, from.size());
  forChunks(from.size(), grain::kNumbers, [&](size_t first, size_t last) {
    std::copy(from.data() + first, from.data() + last, values.data() + first);
  });
}

/// As values.assign(), with `one` and then `other`, whose numbers come and go.
template <class T>
void assignBoth(std::vector<T>& values, std::span<const T> one, std::span<const T> other) {
  lengthen(values, one.size() + other.size(), (one.size() + other.size()) / 32);
  forChunks(values.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) values[k] = k < one.size() ? one[k] : other[k - one.size()];
  });
}

/// Returns what the number was. Threads come in any order: who uses that as a place sorts what is there.
inline uint32_t addOne(uint32_t& number) { return std::atomic_ref(number).fetch_add(1, std::memory_order_relaxed); }

/// Each number becomes the sum of all up to it.
inline void sumUp(std::span<uint32_t> numbers) {
  static thread_local std::vector<uint32_t> room;
  std::vector<uint32_t>& sums = room;  // this thread's, whoever helps it
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
