// SPDX-License-Identifier: Apache-2.0
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 direction;
layout(location = 2) in vec4 material;  // r, g, b in sRGB, kind
out vec3 worldNormal;
out vec3 viewPosition;
flat out vec4 look;
void main() {
  worldNormal = direction;
  look = material;
  vec4 p = view * vec4(position, 1.0);
  viewPosition = p.xyz;
  gl_Position = projection * p;
}
