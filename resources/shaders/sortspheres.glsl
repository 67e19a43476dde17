// SPDX-License-Identifier: Apache-2.0
// Spheres: centre in view space, radius.
uniform float growth;  // of radii

// Tangents of the angles between which a circle is seen, `along` beside the line of sight and `depth` before the eye.
vec2 seen(float along, float depth, float radius) {
  float square = along * along + depth * depth - radius * radius;
  if (square <= 0.0) return vec2(-1e6, 1e6);
  float t = sqrt(square), low = depth * t + radius * along, high = depth * t - radius * along;
  return vec2(low > 0.0 ? (along * t - radius * depth) / low : -1e6,
              high > 0.0 ? (along * t + radius * depth) / high : 1e6);
}

uvec2 placeOf(vec4 sphere) {
  // As when they are drawn: what comes nearer than the near plane does not show at all.
  float away = length(sphere.xyz);
  if (!(sphere.w > 0.0) || -sphere.z * (1.0 - sphere.w / away) < nearestShown() || -sphere.z - sphere.w > farthestShown())
    return kNowhere;
  vec2 x = seen(sphere.x, -sphere.z, sphere.w), y = seen(sphere.y, -sphere.z, sphere.w);
  return pixelsBetween(vec2(x.x, y.x), vec2(x.y, y.y));
}

uvec2 put(int i) {
  vec4 p = texelFetch(particles, (firstParticle + i) * 2);
  things[i] = vec4((view * vec4(p.xyz, 1.0)).xyz, p.w * growth);
  return placeOf(things[i]);
}
