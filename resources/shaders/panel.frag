// SPDX-License-Identifier: Apache-2.0
// A flat picture among the scene: as it is, without the scene's light, behind whatever is nearer.
in vec2 inPicture;
in float away;
uniform sampler2D image;  // sRGB, multiplied by its opacity
uniform sampler2D distanceTexture;
uniform sampler2D fluidTexture;
uniform int fluidScale;  // 0: no liquid
uniform int scale;       // pixels of the scene's layers for one of the picture
uniform ivec2 origin;    // of the picture in its framebuffer, pixels
out vec4 colour;
void main() {
  ivec2 here = (ivec2(gl_FragCoord.xy) - origin) * scale;
  if (texelFetch(distanceTexture, here, 0).r < away) discard;
  if (fluidScale > 0 && texelFetch(fluidTexture, here / max(fluidScale, 1), 0).r < away) discard;
  colour = texture(image, inPicture);
}
