// SPDX-License-Identifier: Apache-2.0
// The surface's normal in view space from smoothed distances: of two differences the smaller, so that edges stay.
uniform sampler2D fluidTexture;

vec3 pointAt(ivec2 at, ivec2 last) {
  return viewRay((vec2(at) + 0.5) / vec2(last + 1)) * texelFetch(fluidTexture, clamp(at, ivec2(0), last), 0).r;
}

bool shade(ivec2 here, vec2 uv, vec3 ray, out vec4 normal) {
  normal = vec4(0.5, 0.5, 1.0, 1.0);
  if (texelFetch(fluidTexture, here, 0).r > kFar * 0.5) return true;
  ivec2 last = textureSize(fluidTexture, 0) - 1;
  vec3 p = pointAt(here, last);
  vec3 right = pointAt(here + ivec2(1, 0), last) - p, left = p - pointAt(here - ivec2(1, 0), last);
  vec3 up = pointAt(here + ivec2(0, 1), last) - p, down = p - pointAt(here - ivec2(0, 1), last);
  vec3 dx = abs(right.z) < abs(left.z) ? right : left;
  vec3 dy = abs(up.z) < abs(down.z) ? up : down;
  normal = vec4(normalize(cross(dx, dy)) * 0.5 + 0.5, 1.0);
  return true;
}
