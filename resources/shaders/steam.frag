// SPDX-License-Identifier: Apache-2.0
uniform sampler2D distanceTexture;
uniform sampler2D cloudTexture;
uniform int scale;
uniform float opacity;
in vec2 corner;
in vec2 grain;
flat in vec4 tint;
flat in vec2 reach;
out vec4 colour;  // premultiplied
void main() {
  float square = dot(corner, corner);
  if (square > 1.0) discard;
  ivec2 at = ivec2(gl_FragCoord.xy) * scale;
  float behind = texelFetch(distanceTexture, at, 0).r;
  float soft = clamp((behind - reach.x) / reach.y + 0.35, 0.0, 1.0);
  float cloud = textureLod(cloudTexture, grain, 0.0).r;
  float fall = 1.0 - square;
  float a = tint.a * opacity * soft * fall * fall * smoothstep(0.18, 0.85, cloud);
  a *= clamp((reach.x / (matter.w * 0.15)) - 0.3, 0.0, 1.0);
  float lit = 0.90 + 0.10 * corner.y + 0.05 * corner.x * sign(light.x);
  colour = vec4(tint.rgb * lit * a, a);
}
