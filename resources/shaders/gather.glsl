// SPDX-License-Identifier: Apache-2.0
// For programs that go through the things of bins.glsl pixel by pixel, in blocks of 8 x 8 or more. Lists are found and
// read by all of a block's invocations together, one list or one thing each, and then gone through by each: one after
// the other would wait for memory each time.
const int kSizes = 16;       // of squares, at most
shared uvec2 lists[kSizes];  // what a block may see, for each size of squares: first and last + 1 in the list

// All invocations of a block must come here first, each with its number; `corner` is the block's.
void findLists(ivec2 corner, uint own) {
  if (own < uint(squareSizes)) {
    int base = 0, shift = smallest;
    for (int step = 0; step < int(own); ++step) {
      ivec2 count = (field + (1 << shift) - 1) >> shift;
      base += count.x * count.y;
      ++shift;
    }
    int columns = (field.x + (1 << shift) - 1) >> shift;
    ivec2 at = corner >> shift;
    lists[own] = squares[base + at.y * columns + at.x];
  }
  barrier();
}
// Whether there is nothing in those that were found.
bool seesNothing() {
  for (int step = 0; step < squareSizes; ++step)
    if (lists[step].x < lists[step].y) return false;
  return true;
}
