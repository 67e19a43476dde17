// SPDX-License-Identifier: Apache-2.0
// How much of a sprite of vapour one sees at a place in it, -1..1 from its middle.
uniform sampler2D distanceTexture;
uniform sampler2D cloudTexture;
uniform int scale;
uniform float opacity;

// The opaque scene behind a pixel.
float behindAt(ivec2 here) {
  return texelFetch(distanceTexture, min(here * scale, textureSize(distanceTexture, 0) - 1), 0).r;
}
// reach: distance of the sprite and half its depth.
float cloudAt(vec2 corner, vec4 turn, vec2 reach, float behind) {
  vec2 grain = mat2(turn.x, turn.y, -turn.y, turn.x) * corner * 0.21 + turn.zw;
  float soft = clamp((behind - reach.x) / reach.y + 0.35, 0.0, 1.0);
  float fall = max(1.0 - dot(corner, corner), 0.0);
  float a = opacity * soft * fall * fall * smoothstep(0.18, 0.85, textureLod(cloudTexture, grain, 0.0).r);
  return a * clamp((reach.x / (matter.w * 0.15)) - 0.3, 0.0, 1.0);
}
float cloudLight(vec2 corner) { return 0.90 + 0.10 * corner.y + 0.05 * corner.x * sign(light.x); }
