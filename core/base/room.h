// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

namespace ps {

/// Makes room for `count` elements at least, all of which are to be written anew, and a thirty-second part more: what
/// breathes with the matter then seldom allocates. A vector that grows by itself doubles, and of the largest arrays
/// that is too much. It never gets smaller: what it would get back would be zeroed, by one thread.
template <class T>
void makeRoomFor(std::vector<T>& values, size_t count) {
  if (count <= values.size()) return;
  values = {};  // before there is the next one
  values.resize(count + count / 32);
}

}  // namespace ps
