// SPDX-License-Identifier: Apache-2.0
// A square across the way to each ball, a little before it and large enough for whatever the eye sees of it.
layout(location = 0) in vec4 ball;  // m: place, radius
uniform mat4 seen, window;          // from the scene to the eye, and on to the picture
out vec3 place;
flat out vec4 own;
void main() {
  own = vec4((seen * vec4(ball.xyz, 1)).xyz, ball.w);
  vec3 forward = normalize(own.xyz);
  vec3 right = normalize(cross(forward, abs(forward.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
  vec3 up = cross(right, forward);
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2 - 1;
  place = own.xyz + 1.5 * own.w * (corner.x * right + corner.y * up);
  gl_Position = window * vec4(place, 1);
}
