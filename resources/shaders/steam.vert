// SPDX-License-Identifier: Apache-2.0
const vec2 kCorners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1), vec2(1, 1));
out vec2 corner;
flat out vec4 turn;
flat out vec4 tint;   // colour, opacity
flat out vec2 reach;  // distance, half depth
void main() {
  Sprite s = spriteOf(gl_VertexID / 6);
  corner = kCorners[gl_VertexID % 6];
  turn = s.turn;
  tint = vec4(s.tint, s.opacity);
  reach = vec2(-s.centre.z, s.radius);
  gl_Position = projection * vec4(s.centre + vec3(corner * s.radius, 0.0), 1.0);
}
