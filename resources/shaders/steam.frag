// SPDX-License-Identifier: Apache-2.0
in vec2 corner;
flat in vec4 turn;
flat in vec4 tint;
flat in vec2 reach;
out vec4 colour;  // premultiplied
void main() {
  if (dot(corner, corner) > 1.0) discard;
  float a = tint.a * cloudAt(corner, turn, reach, behindAt(ivec2(gl_FragCoord.xy)));
  colour = vec4(tint.rgb * cloudLight(corner) * a, a);
}
