// SPDX-License-Identifier: Apache-2.0
// As fluidcolour.frag: sums colour and clearness weighted by thickness, and thickness itself. Whole numbers, so that it is
// all the same in which order. Pixels are few and what lies behind them is much: several invocations share each.
layout(local_size_x = 8, local_size_y = 8, local_size_z = 8) in;
layout(binding = 0) writeonly uniform image2D sum;
layout(binding = 1) writeonly uniform image2D clearSum;
uniform sampler2D distanceTexture;
uniform int scale;
const float kSteps = 4096.0;  // in a radius
const uint kAtOnce = 512u;
shared vec4 batch[kAtOnce], looks[kAtOnce];
shared uint sums[5][64];

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy), corner = 8 * ivec2(gl_WorkGroupID.xy);
  uint pixel = gl_LocalInvocationIndex & 63u, part = gl_LocalInvocationID.z;
  if (part == 0u)
    for (int k = 0; k < 5; ++k) sums[k][pixel] = 0u;
  findLists(corner, gl_LocalInvocationIndex);
  if (seesNothing()) {
    if (part > 0u || any(greaterThanEqual(here, field))) return;
    imageStore(sum, here, vec4(0.0));
    imageStore(clearSum, here, vec4(0.0));
    return;
  }
  float behind = texelFetch(distanceTexture, min(here * scale, textureSize(distanceTexture, 0) - 1), 0).r;
  vec3 ray = viewRay((vec2(here) + 0.5) / vec2(field));
  float a = dot(ray, ray);
  uvec4 total = uvec4(0u);
  uint clear = 0u;
  for (int step = 0; step < squareSizes; ++step) {
    uvec2 range = lists[step];
    for (uint from = range.x; from < range.y; from += kAtOnce) {
      uint count = min(range.y - from, kAtOnce), own = gl_LocalInvocationIndex;
      barrier();
      if (own < count) {
        vec4 look = texelFetch(particles, (firstParticle + int(list[from + own])) * 2 + 1);
        batch[own] = sorted[from + own];
        looks[own] = vec4(toLinear(look.rgb), clamp((look.a - 32.0) / 15.0, 0.0, 1.0));
      }
      barrier();
      for (uint k = part; k < count; k += gl_WorkGroupSize.z) {
        vec4 sphere = batch[k];
        float b = dot(ray, sphere.xyz), root = b * b - a * (dot(sphere.xyz, sphere.xyz) - sphere.w * sphere.w);
        if (root < 0.0 || behind < -sphere.z - sphere.w) continue;
        // 2 sqrt(root / a) in radii, and that squared by the part of the diameter that it is.
        float thickness = 2.0 * root / (a * sphere.w * sphere.w) * kSteps;
        total += uvec4(vec4(looks[k].rgb, 1.0) * thickness + 0.5);
        clear += uint(looks[k].a * thickness + 0.5);
      }
    }
  }
  for (int k = 0; k < 4; ++k) atomicAdd(sums[k][pixel], total[k]);
  atomicAdd(sums[4][pixel], clear);
  barrier();
  if (part > 0u || any(greaterThanEqual(here, field))) return;
  imageStore(sum, here, vec4(sums[0][pixel], sums[1][pixel], sums[2][pixel], sums[3][pixel]) / kSteps);
  imageStore(clearSum, here, vec4(float(sums[4][pixel]) / kSteps));
}
