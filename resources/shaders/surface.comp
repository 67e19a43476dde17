// SPDX-License-Identifier: Apache-2.0
// The nearest opaque surface of each pixel, of spheres and of triangles: what lighting needs later.
layout(binding = 0) writeonly uniform image2D surface;
layout(binding = 1) writeonly uniform image2D normal;
layout(binding = 2) writeonly uniform image2D distances;
uniform usampler2D triangles;  // number from 1, or 0

// Where a ray meets a triangle that it does meet, but for rounding; direction and look there.
float meetTriangle(int i, vec3 ray, out vec3 direction, out vec4 look) {
  vec3 from = cornerPlace(i, 0), u = cornerPlace(i, 1) - from, v = cornerPlace(i, 2) - from, n = cross(u, v);
  float slope = dot(n, ray), square = max(dot(n, n), 1e-37);
  vec3 hit = ray * (dot(n, from - eye.xyz) / (abs(slope) > 1e-37 ? slope : 1e-37)) + eye.xyz - from;
  float y = clamp(dot(cross(hit, v), n) / square, 0.0, 1.0), z = clamp(dot(cross(u, hit), n) / square, 0.0, 1.0 - y);
  direction = cornerDirection(i, 0) * (1.0 - y - z) + cornerDirection(i, 1) * y + cornerDirection(i, 2) * z;
  look = vec4(cornerValue(i, 2, 6), cornerValue(i, 2, 7), cornerValue(i, 2, 8), cornerValue(i, 2, 9));
  return -(view * vec4(from + u * y + v * z, 1.0)).z;
}

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy), corner = 8 * ivec2(gl_WorkGroupID.xy);
  if (isHidden(corner, 8, field)) {
    if (all(lessThan(here, field))) imageStore(distances, here, vec4(kFar));
    return;
  }
  vec3 ray = viewRay((vec2(here) + 0.5) * size.zw), facing = vec3(0.0);
  float distance = farthestShown(), belongs = kMatter;
  vec4 look = vec4(0.0);
  int i = nearestSphere(corner, ray, distance);
  if (any(greaterThanEqual(here, field))) return;
  if (i >= 0) {
    facing = mat3(inverseView) * ((ray * distance - things[i].xyz) / things[i].w);
    look = texelFetch(particles, (firstParticle + i) * 2 + 1);
  }
  uint mark = texelFetch(triangles, here, 0).r;
  if (mark > 0u) {
    vec3 direction;
    vec4 other;
    float there = meetTriangle(int(mark) - 1, mat3(inverseView) * ray, direction, other);
    if (i < 0 || there < distance) {
      distance = there;
      facing = normalize(direction);
      look = other;
      belongs = int(mark) > ofProps ? kFurniture : kHand;
    }
  }
  bool found = i >= 0 || mark > 0u;
  imageStore(distances, here, vec4(found ? distance : kFar));
  if (!found) return;  // the others are read only where something is
  imageStore(surface, here, vec4(look.rgb, look.a * (1.0 / 255.0)));
  imageStore(normal, here, vec4(facing * 0.5 + 0.5, belongs));
}
