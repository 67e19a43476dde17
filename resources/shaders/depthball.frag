// SPDX-License-Identifier: Apache-2.0
in vec3 place;
flat in vec4 own;
uniform mat4 window;
void main() {
  vec3 way = normalize(place);
  float along = dot(way, own.xyz);
  float square = own.w * own.w - dot(own.xyz, own.xyz) + along * along;
  if (square < 0) discard;
  vec4 clip = window * vec4((along - sqrt(square)) * way, 1);
  gl_FragDepth = clip.w > 0 ? clamp(0.5 + 0.5 * clip.z / clip.w, 0, 1) : 0;
}
