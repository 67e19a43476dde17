// SPDX-License-Identifier: Apache-2.0
// What lighting needs of an opaque pixel, and the key light's shadow.
uniform sampler2D surfaceTexture;
uniform sampler2D normalTexture;
uniform sampler2D distanceTexture;
uniform sampler2D openTexture;
uniform sampler2D contactTexture;  // rgb mean colour of what stands above the floor, a how much
uniform int shadowTaps;  // 0: nothing casts a shadow

struct Surface {
  vec3 base, normal, position, toEye;  // linear colour; world
  float kind, open, key;               // open: share of the sky; key: share of the key light
};

float keyVisible(vec3 p, vec3 n) {
  if (shadowTaps == 0) return 1.0;
  vec3 s = (shadow * vec4(p + n * matter.x * 0.6, 1.0)).xyz;
  if (any(lessThan(s, vec3(0.0))) || any(greaterThan(s, vec3(1.0)))) return 1.0;
  vec2 texel = shadowTexel();
  float sum = 0.0;
  vec2 a = vec2(1.5, 0.6) * texel;
  for (int i = 0; i < shadowTaps; ++i) {
    sum += reachesLight(vec3(s.xy + a, s.z));
    a = i == 3 ? vec2(2.6, 2.6) * texel : i % 2 == 0 ? -a : vec2(a.y, -a.x);
  }
  return sum / float(shadowTaps);
}

Surface surfaceAt(ivec2 here, vec2 uv, vec3 ray) {
  vec4 look = texelFetch(surfaceTexture, here, 0);
  Surface s;
  s.base = toLinear(look.rgb);
  s.kind = floor(look.a * 255.0 + 0.5);
  s.normal = texelFetch(normalTexture, here, 0).xyz * 2.0 - 1.0;
  s.position = eye.xyz + ray * texelFetch(distanceTexture, here, 0).r;
  s.toEye = -ray * inversesqrt(dot(ray, ray));
  vec2 beside = vec2(0.5 / float(textureSize(openTexture, 0).x), 0.0);
  s.open = 0.5 * (textureLod(openTexture, uv - beside, 0.0).r + textureLod(openTexture, uv + beside, 0.0).r);
  s.key = keyVisible(s.position, s.normal);
  return s;
}

vec4 finished(vec3 c, ivec2 here) {
  return vec4(toScreen(tone(c)) + (ditherAt(vec2(here) + 7.5) - 0.5) / 255.0, 1.0);
}
