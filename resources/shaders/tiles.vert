// SPDX-License-Identifier: Apache-2.0
// Squares of the picture that liquid may touch, on the far plane, so that full-screen work is done there only.
layout(location = 0) in vec2 corner;  // 0..1
out vec2 uv;
void main() {
  uv = corner;
  gl_Position = vec4(uv * 2.0 - 1.0, 1.0, 1.0);
}
