// SPDX-License-Identifier: Apache-2.0
// Sorts things into squares (bins.glsl), in three rounds: counts those of each, gives each a part of the list, fills it.
// put() comes before: it writes down thing i for those who go through them, and says where it is.
layout(local_size_x = 256) in;
uniform int turn;
uniform int count;  // things, or squares in the second round

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  if (turn == 1) {
    // Most are empty: all of them at one number would wait for each other.
    uint held = squares[i].y, first = 0u;
    if (held > 0u) first = atomicAdd(listed, held);
    squares[i] = uvec2(first);
    return;
  }
  if (turn == 0) {
    places[i] = put(i);
  }
  uvec2 place = places[i];
  if (place == kNowhere) return;
  ivec2 low = ivec2(place.x & 0xFFFFu, place.x >> 16), high = ivec2(place.y & 0xFFFFu, place.y >> 16);
  int wide = max(high.x - low.x, high.y - low.y), step = 0, base = 0, shift = smallest;
  ivec2 counts = (field + (1 << shift) - 1) >> shift;
  while ((1 << shift) <= wide && step + 1 < squareSizes) {
    base += counts.x * counts.y;
    ++step;
    ++shift;
    counts = (field + (1 << shift) - 1) >> shift;
  }
  for (int y = low.y >> shift; y <= high.y >> shift; ++y)
    for (int x = low.x >> shift; x <= high.x >> shift; ++x) {
      uint at = atomicAdd(squares[base + y * counts.x + x].y, 1u);
      if (turn < 2) continue;
      list[at] = uint(i);
      for (int k = 0; k < vectors; ++k) sorted[int(at) * vectors + k] = things[i * vectors + k];
    }
}
