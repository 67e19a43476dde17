// SPDX-License-Identifier: Apache-2.0
// Lights every opaque pixel once: key with shadow, sky, rim, occlusion, the glow of the floor from below.
uniform sampler2D surfaceTexture;
uniform sampler2D normalTexture;
uniform sampler2D distanceTexture;
uniform sampler2D openTexture;
uniform sampler2DShadow shadowTexture;
uniform sampler2D contactTexture;  // rgb mean colour of what stands above the floor, a how much
uniform sampler2D noiseTexture;
uniform int shadowTaps;
in vec2 uv;
out vec4 colour;

float keyVisible(vec3 p, vec3 n) {
  vec3 s = (shadow * vec4(p + n * matter.x * 0.6, 1.0)).xyz;
  if (any(lessThan(s, vec3(0.0))) || any(greaterThan(s, vec3(1.0)))) return 1.0;
  vec2 texel = 1.0 / vec2(textureSize(shadowTexture, 0));
  float spin = ditherAt(gl_FragCoord.xy) * 6.2831853, sum = 0.0;
  vec2 a = vec2(cos(spin), sin(spin)) * texel * 2.1;
  for (int i = 0; i < shadowTaps; ++i) {
    sum += textureLod(shadowTexture, vec3(s.xy + a, s.z), 0.0);
    a = vec2(-a.y, a.x) * (i == 3 ? 0.45 : 1.0);
  }
  return sum / float(shadowTaps);
}

vec3 floorGlow(vec2 p) {
  float r = length(p - plate.xy) / min(plate.z, plate.w);
  float ring = exp(-pow((r - 0.70) / 0.115, 2.0)) + 0.55 * exp(-pow((r - 0.36) / 0.10, 2.0)) + 0.38 * exp(-r * r * 1.6);
  return glowTint.rgb * ground.z * ring;
}

vec3 shadeMetal(vec3 p, vec3 n, vec3 v, vec3 base, float key, float open, bool top) {
  vec2 grain = top ? p.xz : vec2(p.x + p.z, p.y);
  float brush = texture(noiseTexture, grain * vec2(0.35, 9.0) / matter.w).r +
                texture(noiseTexture, grain * vec2(1.1, 27.0) / matter.w + 0.37).r - 1.0;
  vec3 tangent = normalize(cross(n, vec3(0.0, 0.0, 1.0)) + vec3(1e-4));
  vec3 h = normalize(v + light.xyz);
  float ht = dot(h, tangent), hb = dot(h, cross(n, tangent)), hn = max(dot(h, n), 0.05);
  float streak = exp(-(ht * ht * 30.0 + hb * hb * 3.0) / (hn * hn)) * max(dot(n, light.xyz), 0.0);
  float fresnel = pow(1.0 - max(dot(n, v), 0.0), 4.0);
  vec3 mirror = studio(reflect(-v, n), 0.75);
  vec3 c = base * ((0.30 + 0.16 * n.y) * open + 0.72 * key * max(dot(n, light.xyz), 0.0)) * (1.0 + 0.20 * brush);
  c += mirror * (0.16 + 0.5 * fresnel) * open * (1.0 + 0.25 * brush) * mix(vec3(1.0), base * 2.2, 0.5);
  c += vec3(0.55) * streak * key * (1.0 + 0.6 * brush) * base * 1.6;
  return c;
}

vec3 shadeMatter(vec3 n, vec3 v, vec3 base, float kind, float key, float open) {
  float data = matter.z;
  bool matte = kind == 3.0;
  float wet = kind == 2.0 ? 1.0 : 0.0, clear = matte ? 0.0 : 1.0 - data;
  float facing = max(dot(n, v), 0.0), direct = dot(n, light.xyz);
  float wrap = 0.35 * clear;
  float diffuse = max((direct + wrap) / (1.0 + wrap), 0.0) * mix(key, 1.0, 0.22 * clear);
  float sky = 0.5 + 0.5 * n.y;
  vec3 ambient = mix(vec3(0.30, 0.31, 0.34), vec3(0.58, 0.62, 0.68), sky);
  // Light that entered elsewhere: keeps the gaps of clear matter from going grey.
  vec3 inner = clear * base * base * vec3(0.16, 0.22, 0.30);
  float deep = mix(open * open, open, clear * 0.6);
  vec3 c = base * (ambient * deep + vec3(0.80, 0.78, 0.74) * diffuse) + inner * (0.4 + 0.6 * open);
  float fresnel = pow(1.0 - facing, 4.0);
  vec3 h = normalize(v + light.xyz);
  float gloss = matte ? 0.02 : mix(0.30, 0.12, data) + 0.35 * wet;
  float shine = pow(max(dot(n, h), 0.0), mix(42.0, 90.0, wet)) * gloss * key;
  c += vec3(1.0, 0.98, 0.94) * shine * 1.5;
  c += studio(reflect(-v, n), 0.5) * (fresnel * (matte ? 0.04 : 0.22 + 0.15 * wet) + (matte ? 0.0 : 0.02)) * open;
  float rim = pow(1.0 - facing, 3.0) * max(dot(n, normalize(vec3(-light.x, 0.35, -light.z))), 0.0);
  return c + vec3(0.45, 0.55, 0.70) * rim * (matte ? 0.15 : 0.45) * open;
}

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(surfaceTexture, here, 0);
  vec3 n = normalize(texelFetch(normalTexture, here, 0).xyz * 2.0 - 1.0);
  vec3 p = (inverseView * vec4(viewRay(uv) * texelFetch(distanceTexture, here, 0).r, 1.0)).xyz;
  vec3 v = normalize(eye.xyz - p);
  float kind = floor(surface.a * 255.0 + 0.5);
  float open = texture(openTexture, uv).r;
  float key = keyVisible(p, n);
  vec3 base = toLinear(surface.rgb);
  vec4 above = texture(contactTexture, (p.xz - contact.xy) * contact.zw);
  float height = (p.y - ground.x) / matter.w;
  vec3 c;
  if (kind >= 4.0) {
    bool top = kind == 4.0;
    float shade = top ? 1.0 - 0.72 * above.a : 1.0;
    c = shadeMetal(p, n, v, base, key * mix(1.0, shade, 0.5), open * shade, top);
    if (top) c = c + toLinear(above.rgb) * above.a * 0.10 + floorGlow(p.xz) * (1.0 - 0.35 * above.a);
    else if (kind == 5.0) c += floorGlow(p.xz) * 0.25 * max(0.0, 1.0 - abs(height) * 12.0);
  } else {
    c = shadeMatter(n, v, base, kind, key, open);
    float near = exp(-max(height, 0.0) * 11.0) * (0.5 - 0.5 * n.y) + 0.25 * exp(-max(height, 0.0) * 30.0);
    c += glowTint.rgb * ground.z * ground.w * near * base * 1.1 * (1.0 - 0.6 * matter.z);
  }
  colour = vec4(toScreen(tone(c)) + (ditherAt(gl_FragCoord.xy + 7.0) - 0.5) / 255.0, 1.0);
}
