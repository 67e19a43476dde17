// SPDX-License-Identifier: Apache-2.0
// Exact ray against sphere; writes what lighting needs later.
layout(depth_greater) out float gl_FragDepth;
flat in vec4 sphere;
flat in vec4 look;
in vec3 ray;
layout(location = 0) out vec4 surface;
layout(location = 1) out vec4 normal;
layout(location = 2) out float distance;
void main() {
  float a = dot(ray, ray), b = dot(ray, sphere.xyz);
  float root = b * b - a * (dot(sphere.xyz, sphere.xyz) - sphere.w * sphere.w);
  if (root < 0.0) discard;
  vec3 hit = ray * ((b - sqrt(root)) / a);
  surface = vec4(look.rgb, look.a * (1.0 / 255.0));
  normal = vec4(mat3(inverseView) * ((hit - sphere.xyz) / sphere.w) * 0.5 + 0.5, 1.0);
  distance = -hit.z;
  gl_FragDepth = windowDepth(distance);
}
