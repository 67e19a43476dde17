// SPDX-License-Identifier: Apache-2.0
// Squares of the picture that liquid may touch, on the far plane, so that full-screen work is done there only.
layout(location = 0) in vec2 corner;  // 0..1
out vec2 uv;
out vec3 worldRay;  // from the eye, 1 m along the view
void main() {
  uv = corner;
  worldRay = mat3(inverseView) * viewRay(uv);
  gl_Position = vec4(uv * 2.0 - 1.0, 1.0, 1.0);
}
