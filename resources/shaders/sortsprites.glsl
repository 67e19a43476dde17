// SPDX-License-Identifier: Apache-2.0
// Sprites of vapour: centre in view space and radius; turn; opacity.
uvec2 put(int i) {
  Sprite s = spriteOf(i);
  things[3 * i] = vec4(s.centre, s.radius);
  things[3 * i + 1] = s.turn;
  things[3 * i + 2] = vec4(s.opacity, 0.0, 0.0, 0.0);
  if (-s.centre.z < nearestShown() || -s.centre.z > farthestShown()) return kNowhere;
  return pixelsBetween((s.centre.xy - s.radius) / -s.centre.z, (s.centre.xy + s.radius) / -s.centre.z);
}
