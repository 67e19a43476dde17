// SPDX-License-Identifier: Apache-2.0
// A flat picture: as it is, without the scene's light, over the scene, which would hide what is written there, but behind
// hands that are nearer.
in vec2 inPicture;
in float away;
uniform sampler2D image;  // sRGB, multiplied by its opacity
uniform sampler2D distanceTexture;
uniform sampler2D normalTexture;  // a: 0 where a hand is
uniform int scale;                // pixels of the scene's layers for one of the picture
uniform ivec2 origin;             // of the picture in its framebuffer, pixels
out vec4 colour;
void main() {
  ivec2 here = (ivec2(gl_FragCoord.xy) - origin) * scale;
  if (texelFetch(distanceTexture, here, 0).r < away && texelFetch(normalTexture, here, 0).a < 0.5) discard;
  colour = texture(image, inPicture);
}
