// SPDX-License-Identifier: Apache-2.0
// The sprites of vapour one over the other. They have one colour but for how they are lit, so that what they hide together
// is all that counts, and the mean of their light: all the same in which order, as whole numbers.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly uniform image2D painted;
shared vec4 batch[3 * 64];
const float kSteps = 262144.0;            // for 1
const float kLightSteps = 8192.0;         // for 1: room for half a million sprites in a pixel
const uint kOpaque = 64u * uint(kSteps);  // more hides no more
void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy), block = 8 * ivec2(gl_WorkGroupID.xy);
  if (isHidden(block, 8, field)) return;
  findLists(block, gl_LocalInvocationIndex);
  if (seesNothing()) {
    if (all(lessThan(here, field))) imageStore(painted, here, vec4(0.0));
    return;
  }
  vec2 ray = viewRay((vec2(here) + 0.5) / vec2(field)).xy;
  float behind = behindAt(here);
  uint hidden = 0u, lit = 0u, weight = 0u;
  for (int step = 0; step < squareSizes; ++step) {
    uvec2 range = lists[step];
    for (uint from = range.x; from < range.y; from += 64u) {
      uint count = min(range.y - from, 64u);
      barrier();
      for (uint k = gl_LocalInvocationIndex; k < 3u * count; k += 64u) batch[k] = sorted[3u * from + k];
      barrier();
      for (uint k = 0u; k < count; ++k) {
        vec4 sprite = batch[3u * k];
        vec2 corner = (ray * -sprite.z - sprite.xy) / sprite.w;
        if (dot(corner, corner) > 1.0) continue;
        float cloud = cloudAt(corner, batch[3u * k + 1u], vec2(-sprite.z, sprite.w), behind);
        float a = min(batch[3u * k + 2u].x * cloud, 0.99);
        hidden = min(hidden + uint(-log2(1.0 - a) * kSteps + 0.5), kOpaque);
        lit += uint(a * cloudLight(corner) * kLightSteps + 0.5);
        weight += uint(a * kLightSteps + 0.5);
      }
    }
  }
  if (any(greaterThanEqual(here, field))) return;
  float a = 1.0 - exp2(-float(hidden) / kSteps);
  vec3 tint = texelFetch(particles, firstParticle * 2 + 1).rgb;
  imageStore(painted, here, vec4(tint * (float(lit) / max(float(weight), 1.0)) * a, a));
}
