// SPDX-License-Identifier: Apache-2.0
// A sphere with a rim of `reach` pixels around its picture.
uniform float reach;
flat out vec4 sphere;  // centre in view space, radius
flat out float rim;    // width of the rim at the sphere's depth, m
out vec3 ray;
void main() {
  vec4 p = texelFetch(particles, (firstParticle + (gl_VertexID / 3)) * 2);
  sphere = vec4((view * vec4(p.xyz, 1.0)).xyz, p.w);
  rim = reach * max(-sphere.z, 0.0) * 2.0 * lens.y * size.w;
  ray = coverCorner(sphere.xyz, p.w + rim, kAround[gl_VertexID % 3]);
  gl_Position = projection * vec4(ray, 1.0);
}
