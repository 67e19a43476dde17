// SPDX-License-Identifier: Apache-2.0
// A frosted lid: more of the studio at grazing angles, little else.
in vec3 worldNormal;
in vec3 worldPosition;
flat in vec4 look;
uniform sampler2D noiseTexture;
uniform sampler2D distanceTexture;
uniform sampler2D fluidTexture;
uniform int fluidScale;  // 0: no liquid
out vec4 colour;
void main() {
  if (windowDepth(texelFetch(distanceTexture, ivec2(gl_FragCoord.xy), 0).r) < gl_FragCoord.z) discard;
  ivec2 at = ivec2(gl_FragCoord.xy) / max(fluidScale, 1);
  if (fluidScale > 0 && texelFetch(fluidTexture, at, 0).r < 1.0 / gl_FragCoord.w) discard;
  vec3 n = normalize(worldNormal), v = normalize(eye.xyz - worldPosition);
  float facing = abs(dot(n, v));
  float fresnel = pow(1.0 - facing, 3.0);
  vec3 mirror = softStudio(reflect(-v, n));
  float grain = texture(noiseTexture, (worldPosition.xz + worldPosition.y) * 1.7 / matter.w).g;
  float frost = 1.0 + 0.5 * (grain - 0.5);
  vec3 c = toLinear(look.rgb) * mix(0.75, 1.0, abs(n.y)) + mirror * (0.10 + 0.6 * fresnel);
  float a = clamp(look.a * (0.8 + 1.8 * fresnel) * frost, 0.0, 0.85);
  colour = vec4(toScreen(tone(c)) * a, a);
}
