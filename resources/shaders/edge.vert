// SPDX-License-Identifier: Apache-2.0
// Thin lines as ribbons of constant width in pixels.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 other;
layout(location = 2) in vec4 material;  // turned side, opacity, side
uniform float width;  // pixels
out float across;
out float opacity;
void main() {
  vec4 a = projection * view * vec4(position, 1.0), b = projection * view * vec4(other, 1.0);
  vec2 pa = a.xy / max(a.w, 1e-4), pb = b.xy / max(b.w, 1e-4);
  vec2 along = (pb - pa) * size.xy;
  along = length(along) > 1e-3 ? normalize(along) : vec2(1.0, 0.0);
  vec2 side = vec2(-along.y, along.x) * material.x;
  across = material.z * width;
  opacity = material.y;
  gl_Position = a + vec4(side * width * size.zw * a.w, -1e-4 * a.w, 0.0);
}
