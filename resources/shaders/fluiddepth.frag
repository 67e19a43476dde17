// SPDX-License-Identifier: Apache-2.0
layout(depth_greater) out float gl_FragDepth;
flat in vec4 sphere;
in vec3 ray;
layout(location = 0) out float distance;
void main() {
  float a = dot(ray, ray), b = dot(ray, sphere.xyz);
  float root = b * b - a * (dot(sphere.xyz, sphere.xyz) - sphere.w * sphere.w);
  if (root < 0.0) discard;
  distance = -ray.z * ((b - sqrt(root)) / a);
  gl_FragDepth = windowDepth(distance);
}
