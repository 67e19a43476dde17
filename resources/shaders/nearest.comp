// SPDX-License-Identifier: Apache-2.0
// How far the nearest sphere is, kFar where there is none.
layout(binding = 0) writeonly uniform image2D distances;
void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy), corner = 8 * ivec2(gl_WorkGroupID.xy);
  float distance = farthestShown();
  int i = -1;
  if (!isHidden(corner, 8, field)) i = nearestSphere(corner, viewRay((vec2(here) + 0.5) / vec2(field)), distance);
  if (all(lessThan(here, field))) imageStore(distances, here, vec4(i >= 0 ? distance : kFar));
}
