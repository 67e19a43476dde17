// SPDX-License-Identifier: Apache-2.0
// What each pixel shows of the opaque scene and the studio behind it; pixel.comp asks.
uniform vec4 backdrop;  // sRGB in place of the studio; a: 1 where there is one
bool shade(ivec2 here, vec2 uv, vec3 ray, out vec4 colour) {
  if (texelFetch(distanceTexture, here, 0).r > kFar * 0.5) {
    if (backdrop.a > 0.5)
      colour = vec4(backdrop.rgb, 1.0);
    else
      colour = studio(here, uv, ray);
  } else if (abs(texelFetch(normalTexture, here, 0).a - kFurniture) < 0.1) {
    colour = litMetal(here, uv, ray);
  } else {
    colour = litMatter(here, uv, ray);
  }
  return true;
}
