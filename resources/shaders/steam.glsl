// SPDX-License-Identifier: Apache-2.0
// Several soft sprites for a vapour parcel, scattered by its number. Texels: (x, y, z, radius), (r, g, b, seed).
uniform int sprites;
uniform float growth;

struct Sprite {
  vec3 centre;  // in view space
  float radius;
  vec4 turn;  // cosine and sine of the angle by which its cloud is turned, and where that is looked up
  vec3 tint;
  float opacity;
};

float hash(float n) { return fract(sin(n * 12.9898) * 43758.5453); }

Sprite spriteOf(int index) {
  int i = (firstParticle + index / sprites) * 2;
  vec4 p = texelFetch(particles, i), look = texelFetch(particles, i + 1);
  float seed = look.a + float(index % sprites) * 0.317;
  vec3 scatter = vec3(hash(seed), hash(seed + 3.1), hash(seed + 7.7)) - 0.5;
  float angle = hash(seed + 5.3) * 6.2831853 + matter.y * (hash(seed + 9.1) - 0.5) * 0.8;
  Sprite s;
  s.radius = p.w * growth * (0.65 + 0.7 * hash(seed + 1.9));
  s.centre = (view * vec4(p.xyz + scatter * p.w * 2.6, 1.0)).xyz;
  s.turn = vec4(cos(angle), sin(angle), hash(seed + 2.2), hash(seed + 4.4));
  s.tint = look.rgb;
  s.opacity = 0.75 + 0.5 * hash(seed + 6.0);
  return s;
}
