// SPDX-License-Identifier: Apache-2.0
// A disc through the sphere's centre that faces the light: what lies behind the centre is in shadow.
uniform mat4 toLight;      // world to clip space of the shadow picture
uniform vec2 radiusScale;  // metres to clip space
out vec2 corner;
void main() {
  vec4 p = texelFetch(particles, (firstParticle + (gl_VertexID / 3)) * 2);
  corner = kAround[gl_VertexID % 3];
  gl_Position = toLight * vec4(p.xyz, 1.0) + vec4(corner * p.w * radiusScale, 0.0, 0.0);
}
