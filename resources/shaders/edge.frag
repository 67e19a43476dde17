// SPDX-License-Identifier: Apache-2.0
in float across;
in float opacity;
uniform vec3 tint;  // sRGB
uniform float width;
uniform sampler2D distanceTexture;
uniform sampler2D fluidTexture;
uniform int fluidScale;  // 0: no liquid
out vec4 colour;
void main() {
  if (windowDepth(texelFetch(distanceTexture, ivec2(gl_FragCoord.xy), 0).r) < gl_FragCoord.z) discard;
  ivec2 at = ivec2(gl_FragCoord.xy) / max(fluidScale, 1);
  if (fluidScale > 0 && texelFetch(fluidTexture, at, 0).r < 1.0 / gl_FragCoord.w) discard;
  float a = opacity * clamp(width - abs(across), 0.0, 1.0);
  colour = vec4(tint * a, a);
}
