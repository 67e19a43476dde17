// SPDX-License-Identifier: Apache-2.0
// Several soft sprites for a vapour parcel, scattered by its number. Texels: (x, y, z, radius), (r, g, b, seed).
uniform int sprites;
const vec2 kCorners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(-1, 1), vec2(1, -1), vec2(1, 1));
uniform float growth;
out vec2 corner;
out vec2 grain;
flat out vec4 tint;   // colour, opacity
flat out vec2 reach;  // distance, half depth
float hash(float n) { return fract(sin(n * 12.9898) * 43758.5453); }
void main() {
  int index = gl_VertexID / 6;
  int i = (firstParticle + index / sprites) * 2;
  vec4 p = texelFetch(particles, i), look = texelFetch(particles, i + 1);
  float seed = look.a + float(index % sprites) * 0.317;
  vec3 scatter = vec3(hash(seed), hash(seed + 3.1), hash(seed + 7.7)) - 0.5;
  float radius = p.w * growth * (0.65 + 0.7 * hash(seed + 1.9));
  vec3 centre = (view * vec4(p.xyz + scatter * p.w * 2.6, 1.0)).xyz;
  corner = kCorners[gl_VertexID % 6];
  float angle = hash(seed + 5.3) * 6.2831853 + matter.y * (hash(seed + 9.1) - 0.5) * 0.8;
  mat2 turn = mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
  grain = turn * corner * 0.21 + vec2(hash(seed + 2.2), hash(seed + 4.4));
  tint = vec4(look.rgb, 0.75 + 0.5 * hash(seed + 6.0));
  reach = vec2(-centre.z, radius);
  gl_Position = projection * vec4(centre + vec3(corner * radius, 0.0), 1.0);
}
