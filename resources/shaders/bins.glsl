// SPDX-License-Identifier: Apache-2.0
// Spheres and other things sorted into the squares of a picture that they may touch. Squares have several sizes, each twice
// as wide as the one before, and a thing is in at most four of those that are as large as its picture: so that lists
// never take more than four places a thing, however near it is.
layout(std430, binding = 0) buffer Things { vec4 things[]; };   // as who sorts them says
layout(std430, binding = 1) buffer Places { uvec2 places[]; };  // first and last pixel, x and y in 16 bits each
layout(std430, binding = 2) buffer Squares {
  uint listed;  // places taken of all lists
  uint unused;
  uvec2 squares[];  // first in the list and the one behind the last
};
layout(std430, binding = 3) buffer List { uint list[]; };      // numbers of things
layout(std430, binding = 6) buffer Sorted { vec4 sorted[]; };  // the things themselves once more, in the list's order
uniform int vectors;    // of four numbers that a thing takes
uniform ivec2 field;     // pixels of the picture
uniform int squareSizes;
uniform int smallest;    // power of two that is the smallest square's width, pixels, from 3
const uvec2 kNowhere = uvec2(1u, 0u);

// The pixels between two rays through (x, y, -1) in view space.
uvec2 pixelsBetween(vec2 low, vec2 high) {
  vec2 first = (low / lens.xy + 1.0 - projection[2].xy) * 0.5 * vec2(field);
  vec2 last = (high / lens.xy + 1.0 - projection[2].xy) * 0.5 * vec2(field);
  if (any(lessThan(last, vec2(0.0))) || any(greaterThan(first, vec2(field)))) return kNowhere;
  uvec2 a = uvec2(clamp(first, vec2(0.0), vec2(field - 1))), b = uvec2(clamp(last, vec2(0.0), vec2(field - 1)));
  return uvec2(a.x | a.y << 16, b.x | b.y << 16);
}
