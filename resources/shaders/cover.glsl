// SPDX-License-Identifier: Apache-2.0
// Corners of a triangle around the unit circle: one triangle a sphere costs less than the two of a square.
const vec2 kAround[3] = vec2[](vec2(-1.7320508, -1.0), vec2(1.7320508, -1.0), vec2(0.0, 2.0));

// The corner of a triangle that covers a sphere's picture exactly: perpendicular to the line of sight, touching the
// sphere's nearest point, so that no fragment's depth is nearer than the triangle's.
vec3 coverCorner(vec3 centre, float radius, vec2 corner) {
  float distance = max(length(centre), radius * 1.0001);
  vec3 toward = centre / distance;
  vec3 side = normalize(abs(toward.y) < 0.99 ? vec3(toward.z, 0.0, -toward.x) : vec3(0.0, -toward.z, toward.y));
  vec3 up = cross(side, toward);
  float extent = radius * inversesqrt(max(distance * distance - radius * radius, 1e-12)) * (distance - radius);
  return toward * (distance - radius) + (side * corner.x + up * corner.y) * extent;
}
