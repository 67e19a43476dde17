// SPDX-License-Identifier: Apache-2.0
layout(location = 0) in vec3 corner;  // m
uniform mat4 seen, window;            // from the scene to the eye, and on to the picture
void main() { gl_Position = window * (seen * vec4(corner, 1)); }
