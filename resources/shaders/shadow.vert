// SPDX-License-Identifier: Apache-2.0
// A disc through the sphere's centre that faces the light: what lies behind the centre is in shadow.
uniform mat4 toLight;      // world to clip space of the shadow picture
uniform vec2 radiusScale;  // metres to clip space
out vec2 corner;
void main() {
  int i = (firstParticle + gl_VertexID / 3) * 2;
  vec4 p = texelFetch(particles, i);
  corner = kAround[gl_VertexID % 3];
  if (texelFetch(particles, i + 1).a == 7.0) p.w = 0.0;  // a mote
  gl_Position = toLight * vec4(p.xyz, 1.0) + vec4(corner * p.w * radiusScale, 0.0, 0.0);
}
