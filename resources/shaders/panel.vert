// SPDX-License-Identifier: Apache-2.0
layout(location = 0) in vec3 position;  // m
layout(location = 1) in vec2 place;     // in the picture, 0..1 right and down from its upper left corner
out vec2 inPicture;
out float away;
void main() {
  inPicture = place;
  vec4 p = view * vec4(position, 1.0);
  away = -p.z;
  gl_Position = projection * p;
}
