// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace ps {

/// Sum over the members of a body, by parts that follow from their number alone and are added in order: of a large body
/// several threads take them, with the bits of one. add(sum, i) adds particle i; Sum begins as what it is made as, and
/// has +=.
template <class Sum, class Add>
Sum sumOver(std::span<const uint32_t> members, const Add& add) {
  constexpr size_t kMostParts = 64;
  const size_t each = std::max(grain::kParticles, chunkCount(members.size(), kMostParts));
  const auto sum = [&](Sum& own, size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) add(own, members[k]);
  };
  if (members.size() <= each) {
    Sum all{};
    sum(all, 0, members.size());
    return all;
  }
  std::array<Sum, kMostParts> part{};
  forChunks(members.size(), each, [&](size_t first, size_t last) {
    Sum own{};  // of this thread alone: beside those of others each addition would wait for theirs
    sum(own, first, last);
    part[first / each] = own;
  });
  Sum all = part[0];
  for (size_t p = 1; p < chunkCount(members.size(), each); ++p) all += part[p];
  return all;
}

/// visit(i) for each member, of a large body on several threads at once.
template <class Visit>
void forMembers(std::span<const uint32_t> members, const Visit& visit) {
  const auto some = [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) visit(members[k]);
  };
  if (members.size() <= grain::kParticles)
    some(0, members.size());
  else
    forChunks(members.size(), grain::kParticles, some);
}

}  // namespace ps
