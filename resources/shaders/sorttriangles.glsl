// SPDX-License-Identifier: Apache-2.0
// Triangles: for each corner the plane through the eye and the side that faces it, which is above 0 on the triangle's side;
// in the first of them also how far the triangle's own plane is from the eye, times the sum of the three.
uvec2 put(int i) {
  vec3 corners[3];
  for (int k = 0; k < 3; ++k) corners[k] = (view * vec4(cornerPlace(i, k), 1.0)).xyz;
  precise vec3 a = cross(corners[1], corners[2]), b = cross(corners[2], corners[0]), c = cross(corners[0], corners[1]);
  float away = dot(corners[0], a + b + c), side = away < 0.0 ? -1.0 : 1.0;
  things[3 * i] = vec4(a * side, away * side);
  things[3 * i + 1] = vec4(b * side, 0.0);
  things[3 * i + 2] = vec4(c * side, 0.0);

  // What is left of it behind the near plane.
  float least = nearestShown();
  vec2 low = vec2(1e9), high = vec2(-1e9);
  for (int k = 0; k < 3; ++k) {
    vec3 from = corners[k], to = corners[(k + 1) % 3];
    bool before = -from.z >= least;
    if (before) {
      low = min(low, from.xy / -from.z);
      high = max(high, from.xy / -from.z);
    }
    if (before != (-to.z >= least)) {
      vec2 at = mix(from, to, (least + from.z) / (from.z - to.z)).xy / least;
      low = min(low, at);
      high = max(high, at);
    }
  }
  return low.x > high.x ? kNowhere : pixelsBetween(low, high);
}
