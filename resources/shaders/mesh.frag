// SPDX-License-Identifier: Apache-2.0
in vec3 worldNormal;
in vec3 viewPosition;
flat in vec4 look;
uniform float belongs;  // kHand or kFurniture
layout(location = 0) out vec4 surface;
layout(location = 1) out vec4 normal;
layout(location = 2) out float distance;
void main() {
  surface = vec4(look.rgb, look.a * (1.0 / 255.0));
  normal = vec4(normalize(worldNormal) * 0.5 + 0.5, belongs);
  distance = -viewPosition.z;
}
