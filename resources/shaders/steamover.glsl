// SPDX-License-Identifier: Apache-2.0
uniform sampler2D steamTexture;

bool shade(ivec2 here, vec2 uv, vec3 ray, out vec4 colour) {
  colour = textureLod(steamTexture, uv, 0.0);
  return true;
}
