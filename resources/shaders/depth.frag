// SPDX-License-Identifier: Apache-2.0
// How far what was drawn is, as depth: 0 at the near plane, 1 at the far one and where nothing is.
in vec2 uv;
uniform sampler2D distanceTexture;
uniform sampler2D fluidTexture;
uniform int fluidScale;  // 0: no liquid
void main() {
  ivec2 here = ivec2(uv * size.xy);
  float distance = texelFetch(distanceTexture, here, 0).r;
  if (fluidScale > 0) distance = min(distance, texelFetch(fluidTexture, here / max(fluidScale, 1), 0).r);
  gl_FragDepth = distance < 0.5 * kFar ? clamp(windowDepth(distance), 0.0, 1.0) : 1.0;
}
