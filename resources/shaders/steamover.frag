// SPDX-License-Identifier: Apache-2.0
uniform sampler2D steamTexture;
in vec2 uv;
out vec4 colour;
void main() {
  colour = texture(steamTexture, uv);
}
