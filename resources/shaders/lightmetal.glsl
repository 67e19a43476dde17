// SPDX-License-Identifier: Apache-2.0
// The plate: brushed metal, darker under what stands on it, glowing where it is hot.
uniform sampler2D noiseTexture;

vec3 floorGlow(vec2 p) {
  float r = length(p - plate.xy) / min(plate.z, plate.w);
  float outer = (r - 0.70) * 8.7, inner = (r - 0.36) * 10.0;
  float ring = decay(outer * outer) + 0.5 * decay(inner * inner) + 0.30 * decay(r * r * 1.8);
  return glowTint.rgb * ground.z * ring * ring;
}

// Where brushing is looked up, from a place in the world or a change of it.
vec2 grainOf(vec3 p, bool top) {
  return (top ? p.xz : vec2(p.x + p.z, p.y)) * vec2(0.6, 13.0) / matter.w;
}
// What a place on the surface changes by when the ray through it does.
vec3 alongSurface(Surface s, vec3 ray, vec3 change) {
  float away = dot(s.position - eye.xyz, ray) / dot(ray, ray), facing = dot(s.normal, ray);
  return (change - ray * (dot(s.normal, change) / (abs(facing) > 1e-4 ? facing : 1e-4))) * away;
}

vec3 shadeMetal(Surface s, vec3 ray, float key, float open, bool top) {
  vec2 right = grainOf(alongSurface(s, ray, rayToTheRight()), top), up = grainOf(alongSurface(s, ray, rayUpwards()), top);
  float brush = textureGrad(noiseTexture, grainOf(s.position, top), right, up).r - 0.5;
  vec3 n = s.normal, v = s.toEye;
  vec3 tangent = top ? vec3(0.0, 0.0, 1.0) : normalize(vec3(n.z, 0.0, -n.x) + vec3(1e-4));
  vec3 h = normalize(v + light.xyz);
  float ht = dot(h, tangent), hn = max(dot(h, n), 0.05), direct = max(dot(n, light.xyz), 0.0);
  float rest = max(1.0 - hn * hn - ht * ht, 0.0);
  float streak = decay((ht * ht * 5.0 + rest * 22.0) / (hn * hn)) * direct;
  float grazing = 1.0 - max(dot(n, v), 0.0), fresnel = grazing * grazing;
  fresnel *= fresnel;
  // Brushing bends the mirror image along the grain.
  vec3 mirror = softStudio(reflect(-v, normalize(n + tangent * brush * 0.35)));
  vec3 tint = s.base * (1.0 + mix(0.55, 1.1, light.w) * brush);
  vec3 c = tint * ((0.16 + 0.16 * n.y) * open + 0.42 * key * direct);
  vec3 polish = mix(tint * mix(0.62, 1.15, light.w), vec3(0.75), fresnel * 0.6);
  c += mirror * polish * mix(open, 1.0, 0.15) * mix(0.55, 1.0, key);
  return c + vec3(1.0, 0.98, 0.95) * streak * key * (0.20 + 0.35 * brush) * mix(0.4, 1.0, light.w);
}

vec4 litMetal(ivec2 here, vec2 uv, vec3 ray) {
  Surface s = surfaceAt(here, uv, ray);
  bool top = s.kind == 4.0;
  vec4 above = textureLod(contactTexture, (s.position.xz - contact.xy) * contact.zw, 0.0);
  float shade = top ? 1.0 - 0.72 * above.a : 1.0;
  float key = s.key * mix(1.0, shade, 0.5);
  vec3 c = shadeMetal(s, ray, key, s.open * shade, top);
  float near = top ? 1.0 - 0.35 * above.a : 0.25 * max(0.0, 1.0 - abs(s.position.y - ground.x) / matter.w * 12.0);
  vec3 glow = floorGlow(s.position.xz) * near;
  c = c * (1.0 - 0.6 * min(glow.r, 1.0)) + glow + (top ? toLinear(above.rgb) * above.a * 0.10 : vec3(0.0));
  return finished(c, here);
}
