// SPDX-License-Identifier: Apache-2.0
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 direction;
layout(location = 2) in vec4 material;  // r, g, b in sRGB, opacity
out vec3 worldNormal;
out vec3 worldPosition;
flat out vec4 look;
void main() {
  worldNormal = direction;
  worldPosition = position;
  look = material;
  gl_Position = projection * view * vec4(position, 1.0);
}
