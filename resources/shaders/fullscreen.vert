// SPDX-License-Identifier: Apache-2.0
// One triangle over the picture, on the far plane: a depth test of GREATER meets what was drawn, EQUAL what was not.
out vec2 uv;
out vec3 worldRay;  // from the eye, 1 m along the view
void main() {
  uv = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  worldRay = mat3(inverseView) * viewRay(uv);
  gl_Position = vec4(uv * 2.0 - 1.0, 1.0, 1.0);
}
