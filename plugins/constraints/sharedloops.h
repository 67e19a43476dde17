// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/plugin.h>

#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

namespace ps::constraint {

/// Elements that a thread takes at a time.
inline constexpr size_t kSharedAtATime = 1024;

/// visit(k) for each k below `count`, for each of which one thread takes about so long; `grain` at a time.
template <class Visit>
void forShared(const api::Threads* threads, size_t count, double microsecondsEach, const Visit& visit,
               size_t grain = kSharedAtATime) {
  api::shareAmong(threads, count, grain, microsecondsEach * static_cast<double>(count), [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) visit(k);
  });
}

/// Returns what it was. Threads come in any order: numbers that are only counted do not depend on it.
inline uint32_t addOne(uint32_t& number) { return std::atomic_ref(number).fetch_add(1, std::memory_order_relaxed); }

/// Whether wanted(k) is true for any k below `count`; once it is, others are left out.
template <class Wanted>
bool anyShared(const api::Threads* threads, size_t count, double microsecondsEach, const Wanted& wanted) {
  std::atomic<bool> any{false};
  forShared(threads, count, microsecondsEach, [&](size_t k) {
    if (!any.load(std::memory_order_relaxed) && wanted(k)) any.store(true, std::memory_order_relaxed);
  });
  return any;
}

/// Each number becomes the sum of all up to it.
inline void sumUpShared(const api::Threads* threads, std::vector<uint32_t>& numbers, double microsecondsEach) {
  std::vector<uint32_t> sums((numbers.size() + kSharedAtATime - 1) / kSharedAtATime);
  const auto share = [&](const auto& part) {
    api::shareAmong(threads, numbers.size(), kSharedAtATime, microsecondsEach * static_cast<double>(numbers.size()),
                    part);
  };
  share([&](size_t first, size_t last) {
    for (size_t k = first + 1; k < last; ++k) numbers[k] += numbers[k - 1];
    sums[first / kSharedAtATime] = numbers[last - 1];
  });
  uint32_t before = 0;
  for (uint32_t& sum : sums) before += std::exchange(sum, before);
  share([&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) numbers[k] += sums[first / kSharedAtATime];
  });
}

/// Those below `count` for which wanted(k) is true, ascending, whoever finds them. It is asked once.
template <class Wanted>
std::vector<uint32_t> findShared(const api::Threads* threads, size_t count, double microsecondsEach,
                                 const Wanted& wanted) {
  std::vector<std::vector<uint32_t>> found((count + kSharedAtATime - 1) / kSharedAtATime);
  api::shareAmong(threads, count, kSharedAtATime, microsecondsEach * static_cast<double>(count),
                  [&](size_t first, size_t last) {
                    std::vector<uint32_t> own;
                    for (size_t k = first; k < last; ++k) {
                      if (wanted(k)) own.push_back(static_cast<uint32_t>(k));
                    }
                    found[first / kSharedAtATime] = std::move(own);
                  });
  size_t total = 0;
  for (const std::vector<uint32_t>& some : found) total += some.size();
  std::vector<uint32_t> all;
  all.reserve(total);
  for (const std::vector<uint32_t>& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace ps::constraint
