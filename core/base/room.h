// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace ps {

/// Leaves what a vector grows by as it is.
template <class T>
struct LeavingAsItIs : std::allocator<T> {
  template <class Other>
  struct rebind {
    using other = LeavingAsItIs<Other>;
  };
  template <class Made>
  void construct(Made* at) noexcept(std::is_nothrow_default_constructible_v<Made>) {
    ::new (static_cast<void*>(at)) Made;
  }
};
/// Of the largest arrays. What it grows by is to be zeroed by zeroFrom(), by many threads: of one thread the pages of a
/// new array of a million particles would take longer than their frame.
template <class T>
using RoomVector = std::vector<T, LeavingAsItIs<T>>;

/// Elements that a thread copies or clears at a time: some hundred pages.
inline constexpr size_t kRoomChunk = size_t{1} << 16;

template <class T>
void zeroFrom(RoomVector<T>& values, size_t from) {
  forChunks(values.size() - from, kRoomChunk, [&](size_t first, size_t last) {
    std::fill(values.data() + from + first, values.data() + from + last, T{});
  });
}

/// Makes room for `count` elements at least, all of which are to be written anew, and a thirty-second part more: what
/// breathes with the matter then seldom allocates. A vector that grows by itself doubles, and of the largest arrays
/// that is too much. It never gets smaller.
template <class T>
void makeRoomFor(RoomVector<T>& values, size_t count) {
  if (count <= values.size()) return;
  RoomVector<T>().swap(values);  // before there is the next one; {} would keep its memory
  values.resize(count + count / 32);
  zeroFrom(values, 0);
}

}  // namespace ps
