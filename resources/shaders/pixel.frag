// SPDX-License-Identifier: Apache-2.0
// One pixel of what is drawn: as shade() says, which comes before.
in vec2 uv;
in vec3 worldRay;
uniform ivec2 origin;  // of the picture in its framebuffer, pixels
out vec4 colour;
void main() {
  if (!shade(ivec2(gl_FragCoord.xy) - origin, uv, worldRay, colour)) discard;
}
