// SPDX-License-Identifier: Apache-2.0
// The key light's shadow picture where that is drawn: how much of the light reaches a place in it.
uniform sampler2DShadow shadowTexture;
float reachesLight(vec3 s) { return textureLod(shadowTexture, s, 0.0); }
vec2 shadowTexel() { return 1.0 / vec2(textureSize(shadowTexture, 0)); }
