// SPDX-License-Identifier: Apache-2.0
// A line around a body's picture, and a halo around the line so that it shows on any ground.
uniform sampler2D mask;
uniform ivec2 origin;     // of the picture in its framebuffer, pixels
uniform float reach;      // pixels for which the mask falls from 1 to 0
uniform float lineWidth;  // pixels of it that are the line; the rest is halo
uniform vec3 tint;        // sRGB
uniform vec3 halo;
out vec4 colour;
void main() {
  float distance = reach * (1.0 - textureLod(mask, (gl_FragCoord.xy - vec2(origin)) * size.zw, 0.0).r);
  float line = smoothstep(0.0, 1.0, distance) * (1.0 - smoothstep(lineWidth - 0.5, lineWidth + 0.5, distance));
  float dark = 0.6 * smoothstep(0.0, 1.0, distance) * (1.0 - smoothstep(lineWidth, reach, distance));
  colour = vec4(mix(halo, tint, line), max(line, dark));
}
