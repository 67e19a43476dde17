// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

namespace ps {

/// Makes room for `count` elements that are all to be written anew, and a thirty-second part more: what breathes with
/// the matter then seldom allocates. A vector that grows by itself doubles, and of the largest arrays that is too much.
template <class T>
void makeRoomFor(std::vector<T>& values, size_t count) {
  if (count > values.capacity()) {
    values = {};  // before there is the next one
    values.reserve(count + count / 32);
  }
  values.resize(count);
}

}  // namespace ps
