// SPDX-License-Identifier: Apache-2.0
// The key light's shadow picture where that is computed: how much of the light reaches a place in it, between texels.
uniform sampler2D shadowTexture;
float reachesLight(vec3 s) {
  vec2 texels = vec2(textureSize(shadowTexture, 0)), at = s.xy * texels - 0.5, from = floor(at), f = at - from;
  vec4 lit = step(vec4(s.z), textureGather(shadowTexture, (from + 1.0) / texels, 0));
  vec2 across = mix(lit.wx, lit.zy, f.x);
  return mix(across.x, across.y, f.y);
}
vec2 shadowTexel() { return 1.0 / vec2(textureSize(shadowTexture, 0)); }
