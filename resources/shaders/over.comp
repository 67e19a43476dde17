// SPDX-License-Identifier: Apache-2.0
// Each pixel of a picture with shade() over it, which comes before and is multiplied by its opacity.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) writeonly uniform image2D painted;
layout(binding = 1, rgba8) readonly uniform image2D below;  // may be the same
uniform ivec2 used;        // pixels of the picture
uniform ivec2 first, end;  // of the box that is worked on
void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy) + first;
  if (any(greaterThanEqual(here, end)) || isHidden(here, used)) return;
  vec2 uv = (vec2(here) + 0.5) / vec2(used);
  vec4 under = imageLoad(below, here), colour = vec4(0.0);
  if (!shade(here, uv, mat3(inverseView) * viewRay(uv), colour)) colour = vec4(0.0);
  imageStore(painted, here, vec4(colour.rgb + under.rgb * (1.0 - colour.a), under.a));
}
