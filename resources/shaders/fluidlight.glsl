// SPDX-License-Identifier: Apache-2.0
// The liquid's surface from its smoothed distances: Fresnel reflection of the studio over what lies behind, bent and
// tinted by the thickness; where matter is not clear, and in data colours, an opaque lit surface.
uniform sampler2D fluidTexture;      // smoothed distance, kFar where there is none
uniform sampler2D fluidNormal;       // in view space, 0..1
uniform sampler2D fluidColour;       // colour times thickness, thickness, in radii
uniform sampler2D fluidClear;        // clearness times thickness
uniform vec2 thicknessSize;          // texels that the picture takes of the last two
uniform float oneClearness;          // of all liquid; below 0: as fluidClear says
uniform sampler2D distanceTexture;   // of what is opaque
uniform sampler2D behindTexture;     // the picture so far
uniform ivec2 firstLiquid, endLiquid;  // pixels between which all liquid is

// Distance at a place of the picture, interpolated among the neighbours that are liquid; y: their share.
vec2 distanceAt(vec2 at) {
  ivec2 last = textureSize(fluidTexture, 0) - 1;
  vec2 p = at * vec2(last + 1) - 0.5;
  ivec2 i = ivec2(floor(p));
  vec2 f = p - vec2(i);
  vec4 d = vec4(texelFetch(fluidTexture, clamp(i, ivec2(0), last), 0).r,
                texelFetch(fluidTexture, clamp(i + ivec2(1, 0), ivec2(0), last), 0).r,
                texelFetch(fluidTexture, clamp(i + ivec2(0, 1), ivec2(0), last), 0).r,
                texelFetch(fluidTexture, clamp(i + ivec2(1, 1), ivec2(0), last), 0).r);
  vec4 w = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y);
  w *= vec4(lessThan(d, vec4(kFar * 0.5)));
  float sum = w.x + w.y + w.z + w.w;
  return vec2(dot(w, min(d, vec4(kFar))) / max(sum, 1e-5), sum);
}

// Multiplied by its opacity.
bool shade(ivec2 here, vec2 uv, vec3 worldRay, out vec4 colour) {
  if (any(lessThan(here, firstLiquid)) || any(greaterThanEqual(here, endLiquid))) return false;
  vec2 centre = distanceAt(uv);
  float front = texelFetch(distanceTexture, here, 0).r;
  if (centre.y < 0.05 || centre.x > front + matter.x * 0.25) return false;

  vec3 nView = normalize(textureLod(fluidNormal, uv, 0.0).xyz * 2.0 - 1.0);
  vec3 n = mat3(inverseView) * nView;
  vec3 world = eye.xyz + worldRay * centre.x;
  vec3 v = -worldRay * inversesqrt(dot(worldRay, worldRay));

  vec2 part = clamp(uv * thicknessSize, vec2(0.5), thicknessSize - 0.5) / vec2(textureSize(fluidColour, 0));
  vec4 sum = textureLod(fluidColour, part, 0.0);
  vec3 base = sum.rgb / max(sum.a, 1e-4);
  float thickness = sum.a;  // radii
  // Smooth sums draw a rounder edge than the coarse distances: 0.9 is where a lone sphere ends.
  float edge = smoothstep(0.75, 1.1, thickness);
  float facing = clamp(dot(n, v), 0.0, 1.0);
  float grazing = 1.0 - facing, square = grazing * grazing;
  float fresnel = 0.03 + 0.97 * square * square * grazing;
  vec3 mirrored = reflect(-v, n);
  // Soft surroundings with the key box's edge on top, and a bright sky: water shows by what it mirrors.
  float box = smoothstep(0.86, 0.93, dot(mirrored, light.xyz));
  vec3 reflected = softStudio(mirrored) * 1.25 + vec3(1.7, 1.65, 1.6) * box;
  vec3 h = normalize(v + light.xyz);
  vec3 s = (shadow * vec4(world + n * matter.x, 1.0)).xyz;
  float key = reachesLight(s);
  float shine = max(dot(n, h), 0.0);
  shine *= shine;
  shine *= shine;
  shine *= shine;
  shine *= shine;
  shine *= shine;
  float broad = shine;
  shine *= shine;
  shine *= shine;
  shine = (shine * 2.2 * shine + broad * 0.16) * key;
  float diffuse = 0.5 + 0.5 * dot(n, light.xyz);
  float height = (world.y - ground.x) / matter.w;
  vec3 warm = glowTint.rgb * ground.z * ground.w * decay(max(height, 0.0) * 14.0);

  float clear = oneClearness;
  if (clear < 0.0) clear = clamp(textureLod(fluidClear, part, 0.0).r / max(thickness, 1e-4), 0.0, 1.0);
  vec3 c;
  if (matter.z > 0.5) {
    // Data are not seen through: it says which pattern. Where classes mix, their mean would be that of a third one.
    float pattern = floor(15.0 * clear + 0.5);
    if (abs(15.0 * clear - pattern) < 0.2) base *= patternAt(int(pattern), world, 2.0);
    c = base * (0.46 + 0.62 * diffuse * mix(0.62, 1.0, key)) + reflected * fresnel * 0.45 + shine * 0.6;
  } else {
    float reach = clamp(thickness * 0.09, 0.0, 0.55) * matter.x / centre.x / lens.y;
    vec2 bend = nView.xy * reach * vec2(size.y / size.x, 1.0);
    vec3 behind = toLinear(textureLod(behindTexture, clamp(uv - bend, vec2(0.0), vec2(1.0)), 0.0).rgb);
    float veil = 1.0 - decay(0.20 * thickness);
    // Linear in the material's colour: a square of it would turn honey's orange into brick.
    vec3 clearness = mix(vec3(1.0), base * 0.75 + 0.02, veil);
    vec3 body = (base * 0.6 + 0.08) * (0.22 + 0.55 * diffuse * mix(0.5, 1.0, key)) + warm * 0.12;
    c = mix(behind * clearness, body, veil * 0.50);
    c = mix(c, reflected, min(fresnel + 0.06, 1.0)) + shine;
    if (clear < 0.99) {
      vec3 sky = mix(vec3(0.20, 0.21, 0.24), vec3(0.44, 0.47, 0.53), 0.5 + 0.5 * n.y);
      float direct = max(dot(n, light.xyz), 0.0) * key;
      vec3 dense = base * (sky + vec3(0.80, 0.775, 0.73) * direct + warm * 0.3);
      c = mix(dense + reflected * (fresnel * 0.5 + 0.03) + shine * 0.7, c, clear);
    }
  }
  colour = vec4(toScreen(tone(c)) * edge, edge);
  return true;
}
