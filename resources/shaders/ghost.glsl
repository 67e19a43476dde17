// SPDX-License-Identifier: Apache-2.0
// Matter of another run over the picture: hatched, with a line where it ends.
uniform sampler2D ghostTexture;
uniform sampler2D distanceTexture;
uniform sampler2D fluidTexture;
uniform int fluidScale;  // 0: no liquid
uniform float width;     // of the line, pixels
uniform vec3 tint;       // sRGB
uniform vec3 halo;

float ghostAt(vec2 at) { return texelFetch(ghostTexture, clamp(ivec2(at), ivec2(0), ivec2(size.xy) - 1), 0).r; }

// Multiplied by its opacity.
bool shade(ivec2 here, vec2 uv, vec3 ray, out vec4 colour) {
  vec2 pixel = vec2(here) + 0.5;
  float ghost = ghostAt(pixel), scene = texelFetch(distanceTexture, here, 0).r;
  if (ghost >= kFar) return false;
  if (fluidScale > 0) scene = min(scene, texelFetch(fluidTexture, here / fluidScale, 0).r);
  float radius = matter.x;
  bool before = ghost < scene - 0.75 * radius;
  // A surface dips between its spheres by up to a radius, and that of a liquid stands off its own by a quarter.
  if (!before && ghost < scene + 1.5 * radius) return false;
  float away = 0.0;  // the farthest around, beyond what one body's surface turns within so few pixels
  for (int i = 0; i < 8; ++i) {
    float angle = 0.7853982 * float(i);
    away = max(away, ghostAt(pixel + width * vec2(cos(angle), sin(angle))));
  }
  bool line = away > ghost + 8.0 * radius;
  float across = mod(pixel.x + pixel.y, 6.0 * width);
  colour = vec4(tint, line ? 0.95 : across < 1.5 * width ? 0.75 : 0.22);
  if (!line && across >= 1.5 * width && across < 2.75 * width) colour = vec4(halo, 0.45);
  if (!before) colour.a *= 0.5;
  colour.rgb *= colour.a;
  return true;
}
