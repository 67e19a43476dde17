// SPDX-License-Identifier: Apache-2.0
// Sums colour and clearness weighted by thickness, and thickness itself, of the liquid in front of what is opaque.
uniform sampler2D distanceTexture;
uniform int scale;
flat in vec4 sphere;
flat in vec4 look;
in vec3 ray;
layout(location = 0) out vec4 sum;
layout(location = 1) out float clearSum;
void main() {
  float a = dot(ray, ray), b = dot(ray, sphere.xyz);
  float root = b * b - a * (dot(sphere.xyz, sphere.xyz) - sphere.w * sphere.w);
  ivec2 at = min(ivec2(gl_FragCoord.xy) * scale, textureSize(distanceTexture, 0) - 1);
  float behind = texelFetch(distanceTexture, at, 0).r;
  if (root < 0.0 || behind < -sphere.z - sphere.w) discard;
  float thickness = 2.0 * sqrt(root / a);
  thickness *= thickness / (2.0 * sphere.w);
  // Thickness in radii keeps the sums in the range of half floats.
  thickness /= sphere.w;
  sum = vec4(toLinear(look.rgb), 1.0) * thickness;
  clearSum = clamp((look.a - 32.0) / 15.0, 0.0, 1.0) * thickness;
}
