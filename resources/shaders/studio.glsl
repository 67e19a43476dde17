// SPDX-License-Identifier: Apache-2.0
// The studio: a gradient, a ground that fades into it with a faint grid, and the soft shadow of the plate.

float roundedBox(vec2 p, vec2 halfSize, float corner) {
  vec2 q = abs(p) - halfSize + corner;
  return length(max(q, vec2(0.0))) + min(max(q.x, q.y), 0.0) - corner;
}
// Coverage of lines `width` pixels wide at whole numbers of p, which changes by f from pixel to pixel; faded where they
// would crowd.
float lines(vec2 p, vec2 f, float width) {
  vec2 d = abs(fract(p - 0.5) - 0.5) / max(f, vec2(1e-6));
  vec2 c = clamp(width * 0.5 + 0.5 - d, 0.0, 1.0) * clamp(1.0 - f * 3.0, 0.0, 1.0);
  return max(c.x, c.y);
}

vec4 studio(ivec2 here, vec2 uv, vec3 ray) {
  vec2 centred = uv + 0.5 * projection[2].xy - vec2(0.5, 0.56);  // around the line of sight: two eyes see one glow
  float glow = exp(-dot(centred * vec2(1.25, 1.7), centred * vec2(1.25, 1.7)) * 2.6);
  vec3 dark = mix(vec3(0.088, 0.095, 0.104), vec3(0.235, 0.247, 0.260), glow);
  vec3 bright = mix(vec3(0.735, 0.748, 0.765), vec3(0.902, 0.910, 0.918), glow);
  vec3 c = mix(bright, dark, light.w);

  float t = (ground.y - eye.y) / ray.y;
  vec2 p = eye.xz + ray.xz * t;
  vec2 q = p - plate.xy;
  float scale = matter.w;
  float fade = exp(-dot(q, q) / (scale * scale * 5.0));
  float onGround = t > 0.0 && eye.y > ground.y ? 1.0 : 0.0;
  vec3 right = rayToTheRight(), up = rayUpwards();
  vec2 change = (abs(right.xz - ray.xz * (right.y / ray.y)) + abs(up.xz - ray.xz * (up.y / ray.y))) * abs(t) / scale;
  vec2 place = p / scale;
  float grid = max(0.5 * lines(place * 10.0, change * 10.0, 1.0), lines(place * 2.0, change * 2.0, 1.0));
  vec3 floorColour = c * mix(0.955, 0.80, light.w) * mix(1.0, 1.06, fade);
  floorColour += grid * mix(-0.045, 0.040, light.w);
  vec2 offset = light.xz / light.y * (ground.x - ground.y);
  float away = roundedBox(q + offset * 0.6, plate.zw * 1.03, 0.06 * scale) / scale;
  float cover = ground.w * (0.62 * (1.0 - smoothstep(-0.10, 0.16, away)) + 0.25 * (1.0 - smoothstep(-0.2, 0.75, away)));
  floorColour *= 1.0 - cover * mix(0.55, 0.92, light.w);
  c = mix(c, floorColour, onGround * clamp(fade * 1.4, 0.0, 1.0));
  return vec4(c + (ditherAt(vec2(here) + 0.5) - 0.5) / 255.0, 1.0);
}
