// SPDX-License-Identifier: Apache-2.0
// The nearest sphere, for programs with 8 x 8 invocations, which must all come here.
layout(local_size_x = 8, local_size_y = 8) in;
shared vec4 batch[64];

// Where a ray meets a sphere, in lengths of the ray; below 0: nowhere. a: the ray's length squared.
float meeting(vec4 sphere, vec3 ray, float a) {
  float b = dot(ray, sphere.xyz), root = b * b - a * (dot(sphere.xyz, sphere.xyz) - sphere.w * sphere.w);
  return root < 0.0 ? -1.0 : (b - sqrt(root)) / a;
}
// The nearest sphere that a ray with z = -1 meets before `distance`, which becomes that of the meeting; -1: none.
int nearestSphere(ivec2 corner, vec3 ray, inout float distance) {
  float a = dot(ray, ray), least = nearestShown();
  int found = -1;
  findLists(corner, gl_LocalInvocationIndex);
  for (int step = 0; step < squareSizes; ++step) {
    uvec2 range = lists[step];
    for (uint from = range.x; from < range.y; from += 64u) {
      uint count = min(range.y - from, 64u);
      barrier();
      if (gl_LocalInvocationIndex < count) batch[gl_LocalInvocationIndex] = sorted[from + gl_LocalInvocationIndex];
      barrier();
      for (uint k = 0u; k < count; ++k) {
        float t = meeting(batch[k], ray, a);
        if (t < least || t > distance) continue;
        // Lists have no order: of two at one place the first counts.
        int i = int(list[from + k]);
        if (t == distance && found >= 0 && i > found) continue;
        distance = t;
        found = i;
      }
    }
  }
  return found;
}
