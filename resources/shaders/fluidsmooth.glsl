// SPDX-License-Identifier: Apache-2.0
// One direction of the narrow-range filter (Truong & Yuksel 2018): neighbours far behind do not count, neighbours far
// in front count as if they stood at the edge of the range, so that silhouettes stay and bumps go.
uniform sampler2D fluidTexture;
uniform ivec2 direction;
uniform float width;  // m, standard deviation of the filter
uniform int limit;    // taps to each side
uniform int fine;     // 1: neighbouring texels only, which removes the comb that wider steps leave
uniform ivec2 least, most;  // texels between which all liquid is: nothing is known of what lies around

bool shade(ivec2 here, vec2 uv, vec3 ray, out vec4 distance) {
  ivec2 last = textureSize(fluidTexture, 0) - 1;
  float centre = texelFetch(fluidTexture, here, 0).r;
  distance = vec4(centre);
  if (centre > kFar * 0.5) return true;
  float sigma = width / centre / lens.y * 0.5 * float(last.y + 1);
  if (fine == 1) sigma = min(sigma, 0.5 * float(limit));
  float range = width * 1.6, step = max(1.0, ceil(2.0 * sigma / float(limit)));
  float sum = centre, weights = 1.0;
  for (int i = 1; i <= limit; ++i) {
    float w = exp(-0.5 * pow(float(i) * step / max(sigma, 0.3), 2.0));
    ivec2 offset = direction * int(float(i) * step + 0.5);
    float a = texelFetch(fluidTexture, clamp(here + offset, least, most), 0).r;
    float b = texelFetch(fluidTexture, clamp(here - offset, least, most), 0).r;
    float keep = a < centre + range && b < centre + range ? w : 0.0;  // both or none: slopes stay
    sum += keep * (max(a, centre - range) + max(b, centre - range));
    weights += 2.0 * keep;
  }
  distance = vec4(sum / weights);
  return true;
}
