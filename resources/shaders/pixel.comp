// SPDX-License-Identifier: Apache-2.0
// Each pixel of a picture, as shade() says, which comes before: computed, since cards that are made for computing draw
// many times slower.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly uniform image2D painted;
uniform ivec2 used;    // pixels of it
uniform ivec2 origin;  // where they begin in the image
uniform ivec2 first;   // of those that are worked on
void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy) + first;
  if (any(greaterThanEqual(here, used)) || isHidden(here, used)) return;
  vec2 uv = (vec2(here) + 0.5) / vec2(used);
  vec4 colour = vec4(0.0);
  if (shade(here, uv, mat3(inverseView) * viewRay(uv), colour)) imageStore(painted, here + origin, colour);
}
