// SPDX-License-Identifier: Apache-2.0
// Particles are two texels of a buffer: (x, y, z, radius), (r, g, b in sRGB, kind or fraction).
uniform samplerBuffer particles;
uniform int firstParticle;
const vec2 kCorners[4] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(-1, 1), vec2(1, 1));

// The corner of a square that covers a sphere's picture exactly: perpendicular to the line of sight, touching the
// sphere's nearest point, so that no fragment's depth is nearer than the square's.
vec3 coverCorner(vec3 centre, float radius, vec2 corner) {
  float distance = max(length(centre), radius * 1.0001);
  vec3 toward = centre / distance;
  vec3 side = normalize(abs(toward.y) < 0.99 ? vec3(toward.z, 0.0, -toward.x) : vec3(0.0, -toward.z, toward.y));
  vec3 up = cross(side, toward);
  float extent = radius * inversesqrt(max(distance * distance - radius * radius, 1e-12)) * (distance - radius);
  return toward * (distance - radius) + (side * corner.x + up * corner.y) * extent;
}
