// SPDX-License-Identifier: Apache-2.0
// The triangles of the scene, behind those of hands and what is in them. Corners: place, direction, colour and kind.
layout(std430, binding = 4) readonly buffer Scene { float scene[]; };
layout(std430, binding = 5) readonly buffer Props { float props[]; };
uniform int ofProps;  // triangles
const int kCorner = 10;

float cornerValue(int triangle, int corner, int value) {
  int at = (3 * triangle + corner) * kCorner + value;
  return triangle < ofProps ? props[at] : scene[at - 3 * kCorner * ofProps];
}
vec3 cornerPlace(int triangle, int corner) {
  return vec3(cornerValue(triangle, corner, 0), cornerValue(triangle, corner, 1), cornerValue(triangle, corner, 2));
}
vec3 cornerDirection(int triangle, int corner) {
  return vec3(cornerValue(triangle, corner, 3), cornerValue(triangle, corner, 4), cornerValue(triangle, corner, 5));
}
