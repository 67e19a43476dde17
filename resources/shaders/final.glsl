// SPDX-License-Identifier: Apache-2.0
// Smooths stair steps along edges (after T. Lottes, "FXAA", 2009), or averages 2 x 2 samples of a still in linear
// light.
uniform sampler2D picture;
uniform int still;
const vec3 kLuma = vec3(0.299, 0.587, 0.114);

vec3 averaged(ivec2 p) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) sum += toLinear(texelFetch(picture, p + ivec2(i & 1, i >> 1), 0).rgb);
  return toScreen(sum * 0.25);
}

bool shade(ivec2 here, vec2 place, vec3 ray, out vec4 colour) {
  if (still == 1) {
    colour = vec4(averaged(here * 2), 1.0);
    return true;
  }
  ivec2 last = ivec2(size.xy) - 1;
  vec3 middle = texelFetch(picture, here, 0).rgb;
  float m = dot(middle, kLuma);
  float nw = dot(texelFetch(picture, clamp(here + ivec2(-1, 1), ivec2(0), last), 0).rgb, kLuma);
  float ne = dot(texelFetch(picture, clamp(here + ivec2(1, 1), ivec2(0), last), 0).rgb, kLuma);
  float sw = dot(texelFetch(picture, clamp(here + ivec2(-1, -1), ivec2(0), last), 0).rgb, kLuma);
  float se = dot(texelFetch(picture, clamp(here + ivec2(1, -1), ivec2(0), last), 0).rgb, kLuma);
  float low = min(m, min(min(nw, ne), min(sw, se))), high = max(m, max(max(nw, ne), max(sw, se)));
  if (high - low < max(0.03, high * 0.10)) {  // most pixels: there is no edge
    colour = vec4(middle, 1.0);
    return true;
  }
  vec2 along = vec2(sw + se - nw - ne, nw + sw - ne - se);
  float least = max((nw + ne + sw + se) * 0.03125, 1.0 / 128.0);
  along = clamp(along / (min(abs(along.x), abs(along.y)) + least), -1.5, 1.5) * size.zw;
  vec2 uv = (vec2(here) + 0.5) * size.zw;
  vec3 both = textureLod(picture, uv - along * 0.5, 0.0).rgb + textureLod(picture, uv + along * 0.5, 0.0).rgb;
  colour = vec4(0.5 * both, 1.0);
  return true;
}
