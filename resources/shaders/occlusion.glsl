// SPDX-License-Identifier: Apache-2.0
// Ambient occlusion at half resolution after McGuire et al. 2011 ("The Alchemy screen-space ambient obscurance
// algorithm"), with two patterns in a chequerboard that the two look-ups of the lighting pass average.
uniform sampler2D normalTexture;
uniform sampler2D distanceTexture;
uniform float radius;     // m
uniform int samples;
uniform int scale;        // full pixels per pixel here
bool shade(ivec2 at, vec2 uv, vec3 ray, out vec4 open) {
  ivec2 here = at * scale;
  float depth = texelFetch(distanceTexture, here, 0).r;
  if (depth > kFar * 0.5) {
    open = vec4(1.0);
    return true;
  }
  vec2 pixel = vec2(here) + 0.5;
  vec3 p = viewRay(pixel * size.zw) * depth;
  vec3 n = mat3(view) * (texelFetch(normalTexture, here, 0).xyz * 2.0 - 1.0);
  float reach = clamp(radius / depth / lens.y * 0.5 * size.y, 3.0, 90.0);
  float odd = float((at.x + at.y) & 1);
  float sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    float t = (float(i) + 0.25 + 0.5 * odd) / float(samples);
    float angle = t * 6.2831853 * 2.0 + odd * 3.1415927;
    ivec2 beside = clamp(here + ivec2(vec2(cos(angle), sin(angle)) * (t * reach)), ivec2(0), ivec2(size.xy) - 1);
    vec3 v = viewRay((vec2(beside) + 0.5) * size.zw) * texelFetch(distanceTexture, beside, 0).r - p;
    float square = dot(v, v);
    float near = max(1.0 - square / (radius * radius), 0.0);
    sum += max(dot(v, n) - 0.02 * radius, 0.0) * near * inversesqrt(square + 1e-4 * radius * radius);
  }
  open = vec4(clamp(1.0 - 1.9 * sum / float(samples), 0.0, 1.0));
  return true;
}
