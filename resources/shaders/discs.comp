// SPDX-License-Identifier: Apache-2.0
// The shadow picture: depth of the nearest disc, what lies behind the centre of a sphere is in shadow.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly uniform image2D depths;
uniform vec2 radiusScale;  // metres to clip space
shared vec4 batch[64];

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy), block = 8 * ivec2(gl_WorkGroupID.xy);
  vec2 place = vec2(here) + 0.5, metres = 2.0 / (radiusScale * vec2(field));
  float depth = 1.0;
  findLists(block, gl_LocalInvocationIndex);
  for (int step = 0; step < squareSizes; ++step) {
    uvec2 range = lists[step];
    for (uint from = range.x; from < range.y; from += 64u) {
      uint count = min(range.y - from, 64u);
      barrier();
      if (gl_LocalInvocationIndex < count) batch[gl_LocalInvocationIndex] = sorted[from + gl_LocalInvocationIndex];
      barrier();
      for (uint k = 0u; k < count; ++k) {
        vec2 off = (place - batch[k].xy) * metres;
        if (dot(off, off) <= batch[k].w * batch[k].w) depth = min(depth, batch[k].z);
      }
    }
  }
  if (all(lessThan(here, field))) imageStore(depths, here, vec4(depth));
}
