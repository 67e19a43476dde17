// SPDX-License-Identifier: Apache-2.0
// Squares of the picture that nobody sees, as behind the edge of a lens: row by row from its upper left corner, a bit each.
layout(std430, binding = 7) readonly buffer Hidden {
  int hiddenColumns;  // 0: all of it is seen
  uint hiddenTiles[];
};

// Of a pixel of a layer, which has one for each few of the picture.
bool isHidden(ivec2 pixel, ivec2 layer) {
  if (hiddenColumns == 0) return false;
  // Rounded up; by floats, since every pixel of every pass asks. They are off by less than what is taken away, and a
  // layer that is no whole number of times as small is off by more.
  int scale = int(ceil(size.x / float(layer.x) - 1e-5));
  ivec2 place = min(pixel * scale, ivec2(size.xy) - 1);
  int i = ((int(size.y) - 1 - place.y) >> 4) * hiddenColumns + (place.x >> 4);
  return (hiddenTiles[i >> 5] >> uint(i & 31) & 1u) == 1u;
}
// Of a whole block of pixels that is no wider than a square.
bool isHidden(ivec2 corner, int side, ivec2 layer) {
  return isHidden(corner, layer) && isHidden(min(corner + side, layer) - 1, layer);
}
