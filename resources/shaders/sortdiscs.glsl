// SPDX-License-Identifier: Apache-2.0
// Discs through spheres' centres that face the light: centre in pixels of the shadow picture and depth in it, radius in m.
uniform mat4 toLight;      // world to clip space of the shadow picture
uniform vec2 radiusScale;  // metres to clip space
uvec2 put(int i) {
  vec4 p = texelFetch(particles, (firstParticle + i) * 2);
  if (texelFetch(particles, (firstParticle + i) * 2 + 1).a == 7.0) return kNowhere;  // a mote
  vec3 at = (toLight * vec4(p.xyz, 1.0)).xyz * 0.5 + 0.5;
  vec2 middle = at.xy * vec2(field), reach = p.w * radiusScale * 0.5 * vec2(field);
  things[i] = vec4(middle, at.z, p.w);
  if (any(lessThan(middle + reach, vec2(0.0))) || any(greaterThan(middle - reach, vec2(field)))) return kNowhere;
  uvec2 low = uvec2(clamp(middle - reach, vec2(0.0), vec2(field - 1)));
  uvec2 high = uvec2(clamp(middle + reach, vec2(0.0), vec2(field - 1)));
  return uvec2(low.x | low.y << 16, high.x | high.y << 16);
}
