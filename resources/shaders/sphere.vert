// SPDX-License-Identifier: Apache-2.0
flat out vec4 sphere;  // centre in view space, radius
flat out vec4 look;    // colour, kind
out vec3 ray;
void main() {
  int i = (firstParticle + (gl_VertexID / 3)) * 2;
  vec4 p = texelFetch(particles, i);
  look = texelFetch(particles, i + 1);
  sphere = vec4((view * vec4(p.xyz, 1.0)).xyz, p.w);
  ray = coverCorner(sphere.xyz, sphere.w, kAround[gl_VertexID % 3]);
  gl_Position = projection * vec4(ray, 1.0);
}
