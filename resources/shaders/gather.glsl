// SPDX-License-Identifier: Apache-2.0
// For programs that go through the things of bins.glsl pixel by pixel, 8 x 8 at once. Lists
// are read by all of a block's invocations together, one thing each, and then gone through by each: one after the other
// would wait for memory each time.
// What an 8 x 8 block may see, of one size of squares: first and last + 1 in the list. `base` is the number of
// squares of smaller sizes, and becomes that with these.
uvec2 listAt(int step, ivec2 corner, inout int base) {
  int shift = smallest + step;
  ivec2 count = (field + (1 << shift) - 1) >> shift;
  ivec2 at = corner >> shift;
  uvec2 found = squares[base + at.y * count.x + at.x];
  base += count.x * count.y;
  return found;
}
