// SPDX-License-Identifier: Apache-2.0
// Which triangle is nearest in each pixel: its number from 1, and 0 where there is none. A block's invocations first sort
// out what the block may see, of as many triangles at once as they are; most are large and thin.
layout(local_size_x = 16, local_size_y = 16) in;
layout(binding = 0) writeonly uniform uimage2D marks;
const uint kAtOnce = 256u;
shared uint starts[kSizes + 1];  // of the lists, one after the other; the last is how long all are
shared uint seen[kAtOnce];
shared uint seenCount;

void placeLists() {
  uint sum = 0u;
  for (int step = 0; step <= kSizes; ++step) {
    starts[step] = sum;
    if (step < squareSizes) sum += lists[step].y - lists[step].x;
  }
}

// Whether a triangle may touch a block: none of its sides has all of the block beyond it.
bool touches(int i, vec3 middle, vec2 reach) {
  for (int k = 0; k < 3; ++k) {
    vec3 side = things[3 * i + k].xyz;
    if (dot(side, middle) + dot(abs(side.xy), reach) < 0.0) return false;
  }
  return true;
}

void main() {
  ivec2 here = ivec2(gl_GlobalInvocationID.xy), corner = 16 * ivec2(gl_WorkGroupID.xy);
  if (isHidden(corner, 16, field)) return;
  uint own = gl_LocalInvocationIndex;
  findLists(corner, own);
  if (own == 0u) placeLists();
  barrier();
  int last = squareSizes - 1;
  uint all = starts[kSizes];
  vec3 ray = viewRay((vec2(here) + 0.5) * size.zw), middle = viewRay((vec2(corner) + 8.0) * size.zw);
  vec2 reach = 16.0 * size.zw * lens.xy;
  float distance = farthestShown(), least = nearestShown();
  uint mark = 0u;
  for (uint from = 0u; from < all; from += kAtOnce) {
    if (own == 0u) seenCount = 0u;
    barrier();
    uint at = from + own;
    if (at < all) {
      int step = 0;
      while (step < last && starts[step + 1] <= at) ++step;
      uint i = list[lists[step].x + at - starts[step]];
      if (touches(int(i), middle, reach)) seen[atomicAdd(seenCount, 1u)] = i;
    }
    barrier();
    for (uint k = 0u; k < seenCount; ++k) {
      int i = int(seen[k]);
      vec4 first = things[3 * i];
      precise float a = dot(first.xyz, ray), b = dot(things[3 * i + 1].xyz, ray), c = dot(things[3 * i + 2].xyz, ray);
      float sum = a + b + c;
      if (min(a, min(b, c)) < 0.0 || !(sum > 0.0)) continue;
      float t = first.w / sum;
      uint found = uint(i) + 1u;
      // Lists have no order: of two at one place the first counts.
      if (t < least || t > distance || (t == distance && found > mark)) continue;
      distance = t;
      mark = found;
    }
    barrier();
  }
  if (any(greaterThanEqual(here, field))) return;
  imageStore(marks, here, uvec4(mark));
}
