// SPDX-License-Identifier: Apache-2.0
// 1 on a sphere, falling to 0 at the end of its rim. The largest of all is how far a pixel is from the body's picture.
flat in vec4 sphere;
flat in float rim;
in vec3 ray;
out float nearness;
void main() {
  // The foot of the perpendicular first: squares of lengths would cancel far away.
  vec3 off = sphere.xyz - ray * (dot(ray, sphere.xyz) / dot(ray, ray));
  nearness = clamp(1.0 - (length(off) - sphere.w) / max(rim, 1e-9), 0.0, 1.0);
}
