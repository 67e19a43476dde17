// SPDX-License-Identifier: Apache-2.0
in vec2 uv;
in vec3 worldRay;
out vec4 colour;
void main() { colour = studio(ivec2(gl_FragCoord.xy), uv, worldRay); }
