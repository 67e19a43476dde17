// SPDX-License-Identifier: Apache-2.0
// Particles of solid matter: key with shadow, sky, occlusion, rim, and the glow of the floor from below.

vec3 shadeMatter(vec3 n, vec3 v, vec3 base, float kind, float key, float open) {
  float data = matter.z;
  bool matte = kind == 3.0, wetted = kind >= 32.0;
  float wet = wetted ? 1.0 : 0.0, clear = kind < 16.0 ? 0.0 : (kind - (wetted ? 32.0 : 16.0)) / 15.0;
  float facing = max(dot(n, v), 0.0), direct = dot(n, light.xyz);
  float wrap = 0.35 * clear;
  float diffuse = max((direct + wrap) / (1.0 + wrap), 0.0) * mix(key, 1.0, 0.22 * clear);
  float sky = 0.5 + 0.5 * n.y;
  vec3 ambient = mix(vec3(0.18, 0.20, 0.24), vec3(0.42, 0.46, 0.53), sky) * mix(1.25, 1.0, light.w);
  float deep = mix(open, open * open, 0.6);
  // Light that entered elsewhere keeps the gaps of clear matter from going grey.
  vec3 inner = clear * base * base * vec3(0.03, 0.10, 0.22) * (0.35 + 0.65 * open);
  vec3 c = base * (ambient * deep + vec3(0.80, 0.775, 0.73) * diffuse * mix(1.0, open, 0.35)) + inner;
  float fresnel = 1.0 - facing;
  fresnel *= fresnel * fresnel;
  vec3 h = normalize(v + light.xyz);
  float gloss = matte ? 0.02 : mix(mix(0.25, 0.55, clear), 0.14, data) + 0.35 * wet;
  float shine = max(dot(n, h), 0.0);
  shine *= shine;
  shine *= shine;
  shine *= shine;
  shine *= shine;
  shine *= shine;
  shine *= mix(shine, shine * shine, wet) * gloss * key;
  c += vec3(1.0, 0.98, 0.94) * shine * 1.5;
  c += softStudio(reflect(-v, n)) * (fresnel * (matte ? 0.04 : 0.20 + 0.15 * wet) + (matte ? 0.0 : 0.03)) * open;
  float rim = fresnel * max(dot(n, vec3(-light.x, 0.35, -light.z) * 1.6), 0.0);
  return c + vec3(0.45, 0.55, 0.70) * rim * (matte ? 0.15 : 0.55) * open;
}

vec4 litMatter(ivec2 here, vec2 uv, vec3 ray) {
  Surface s = surfaceAt(here, uv, ray);
  if (s.kind > 8.0 && s.kind < 12.0) s.base *= patternAt(int(s.kind) - 8, s.position, 8.0);
  vec3 c = shadeMatter(s.normal, s.toEye, s.base, s.kind, s.key, s.open);
  float height = max((s.position.y - ground.x) / matter.w, 0.0);
  float near = decay(height * 11.0) * (0.5 - 0.5 * s.normal.y) + 0.25 * decay(height * 30.0);
  c += glowTint.rgb * ground.z * ground.w * near * s.base * 1.1 * (1.0 - 0.6 * matter.z);
  return finished(c, here);
}
