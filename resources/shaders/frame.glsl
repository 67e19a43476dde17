// SPDX-License-Identifier: Apache-2.0
// What every pass of a frame knows. Lengths are metres, colours of lighting are linear, colours of targets are sRGB.
layout(std140, binding = 0) uniform Frame {
  mat4 view;
  mat4 projection;
  mat4 inverseView;
  mat4 shadow;    // world to shadow texture, 0..1
  vec4 eye;       // position
  vec4 size;      // picture: width, height, their inverses, pixels
  vec4 lens;      // half the window's size at a distance of 1; projection[2][2], projection[3][2]
  vec4 light;     // unit vector to the key light; w: 1 dark theme, 0 light theme
  vec4 plate;     // centre x, z and half size x, z of the floor
  vec4 ground;    // height of the floor, height of the ground below it, glow 0..1, has a floor
  vec4 contact;   // contact map: x, z of its corner, inverse of its size
  vec4 matter;    // radius of a particle, time in s, 1 when colours show data, size of the scene
  vec4 glowTint;  // rgb of the hot floor; w: amount of frost on the lid
};

const float kFar = 1e6;
// What a surface belongs to, in the fourth channel of its normal: to a hand, to walls and floors, or it is matter.
const float kHand = 0.0, kFurniture = 2.0 / 3.0, kMatter = 1.0;

// The sRGB curves without powers, within 0.3 % (I. Taylor, "sRGB approximations for HLSL", 2013): a third of the time
// where a processor draws.
vec3 toLinear(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }
vec3 toScreen(vec3 c) {
  vec3 a = sqrt(max(c, vec3(0.0))), b = sqrt(a);
  return 0.662002687 * a + 0.684122060 * b - 0.323583601 * sqrt(b) - 0.0225411470 * c;
}
// Leaves colours below 0.7 alone, so that data keep the legend's colours, and rolls highlights off towards 1.
vec3 tone(vec3 c) {
  vec3 over = max(c - 0.7, vec3(0.0));
  return min(c, vec3(0.7)) + 0.3 * over / (over + 0.3);
}
// Interleaved gradient noise (Jimenez 2014), 0..1 by pixel.
float ditherAt(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

// Close to exp(-x) for x >= 0, without it.
float decay(float x) {
  float t = max(1.0 - 0.125 * x, 0.0);
  t *= t;
  t *= t;
  return t * t;
}

// The window need not be centred on the line of sight: projection[2] says by how much it is not.
vec3 viewRay(vec2 uv) { return vec3((uv * 2.0 - 1.0 + projection[2].xy) * lens.xy, -1.0); }
// How the ray from the eye, 1 m along the view, changes from a pixel of the picture to the next.
vec3 rayToTheRight() { return inverseView[0].xyz * (2.0 * size.z * lens.x); }
vec3 rayUpwards() { return inverseView[1].xyz * (2.0 * size.w * lens.y); }
float nearestShown() { return lens.w / (lens.z - 1.0); }  // distances of the planes between which things show
float farthestShown() { return lens.w / (lens.z + 1.0); }
float windowDepth(float distance) { return 0.5 - 0.5 * (lens.z - lens.w / distance); }

// By how much a place of matter is darkened so that classes are told apart without their colours: 1 stripes, 2 dots,
// 3 checks. In the scene and not on the picture, so that both eyes see it where the matter is; seen along a slanted
// line, so that it shows on level, upright and facing surfaces alike. A fortieth of the picture's height to a twentieth
// in the middle of the scene, twelve pixels and so many radii of a particle at least: between balls it is dark as well.
float patternAt(int pattern, vec3 world, float least) {
  if (pattern < 1) return 1.0;
  float height = 2.0 * lens.y * max(distance(eye.xyz, vec3(plate.x, ground.x, plate.y)), 1e-3);  // of the picture, m
  float period = matter.x * exp2(ceil(log2(max(max(0.025, 12.0 * size.w) * height / matter.x, least))));
  vec2 at = (world.xy + vec2(0.6, 0.8) * world.z) / period, cell = abs(fract(at) - 0.5);
  float soft = 0.03 + 0.5 * height * size.w / period, mark;
  if (pattern == 1) {
    mark = 1.0 - smoothstep(0.22 - soft, 0.22 + soft, abs(fract(at.x + at.y) - 0.5));
  } else if (pattern == 2) {
    mark = 1.0 - smoothstep(0.3 - soft, 0.3 + soft, length(cell));
  } else {
    vec2 side = smoothstep(vec2(0.25 - soft), vec2(0.25 + soft), cell);
    mark = side.x + side.y - 2.0 * side.x * side.y;
  }
  return mix(1.0, 0.32, mark);
}

// The studio around the scene as surfaces mirror it, linear: a soft gradient and a large box around the key light.
vec3 softStudio(vec3 d) {
  float up = d.y * 0.5 + 0.5, box = max(dot(d, light.xyz), 0.0);
  box *= box;
  box *= box;
  vec3 c = mix(vec3(0.055, 0.058, 0.065), vec3(0.34, 0.37, 0.41), up * up);
  return mix(c * 1.7 + 0.12, c, light.w) + vec3(1.25, 1.20, 1.12) * box * box;
}
