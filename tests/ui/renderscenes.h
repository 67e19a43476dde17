// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"

#include <epoxy/gl.h>

#include <array>
#include <cmath>

// Snapshots and furniture that the tests of the renderer draw.
namespace ps::testing {

inline constexpr int kWidth = 320, kHeight = 200;  // pixels

/// All that there is to choose of a picture.
struct Shot {
  Look look;
  Camera camera;
  PictureSize size{kWidth, kHeight, false};
  Eye eye() const { return eyeOf(camera, size.width, size.height); }
};

inline std::vector<uint8_t> renderImage(Renderer& renderer, const Snapshot& snapshot, const RenderScene& scene,
                                        const Shot& shot) {
  renderer.prepare(snapshot, nullptr, 1, scene, shot.look);
  return ps::renderImage(renderer, shot.eye(), shot.size);
}

inline void addParticle(Snapshot& s, const Vector3& p, double radius, uint32_t id, api::Motion motion,
                        double temperature = 280) {
  s.position.push_back(
      {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), static_cast<float>(radius)});
  s.temperature.push_back(static_cast<float>(temperature));
  s.speed.push_back(static_cast<float>(std::abs(p[0])));
  s.densityError.push_back(0.01f);
  s.gasFraction.push_back(motion == api::Motion::Gas ? 1.f : 0.f);
  s.phase.push_back(motion == api::Motion::Gas      ? api::Phase::Gas
                    : motion == api::Motion::Liquid ? api::Phase::Liquid
                                                    : api::Phase::Solid);
  s.motion.push_back(motion);
  s.id.push_back(id);
  s.body.push_back(0);
  s.material.push_back(0);
}

/// Names in use among the first thousand, of the context that is current: what a renderer leaves behind shows here.
inline std::array<int, 6> objectsInUse() {
  std::array<int, 6> count{};
  for (GLuint name = 1; name < 1000; ++name) {
    count[0] += glIsTexture(name);
    count[1] += glIsBuffer(name);
    count[2] += glIsProgram(name);
    count[3] += glIsFramebuffer(name);
    count[4] += glIsVertexArray(name);
    count[5] += glIsQuery(name);
  }
  return count;
}

inline SceneWall wall(const char* id, const Vector3& point, const Vector3& normal, double temperature) {
  SceneWall w;
  w.id = w.name = id;
  w.point = point;
  w.normal = normal;
  if (temperature > 0) {
    w.parameters.values["heat"] = std::string("fixed_temperature");
    w.parameters.values["temperature"] = temperature;
  }
  return w;
}

inline RenderScene tray() {
  RenderScene scene;
  scene.environment.boundsMinimum = {-0.5, 0, -0.5};
  scene.environment.boundsMaximum = {0.5, 1, 0.5};
  scene.environment.walls = {wall("floor", {0, 0, 0}, {0, 1, 0}, 400), wall("lid", {0, 0.8, 0}, {0, -1, 0}, 283),
                             wall("left", {-0.4, 0, 0}, {1, 0, 0}, 0), wall("right", {0.4, 0, 0}, {-2, 0, 0}, 0),
                             wall("back", {0, 0, -0.4}, {0, 0, 1}, 0), wall("front", {0, 0, 0.4}, {0, 0, -1}, 0)};
  return scene;
}

// A block of ice in a puddle under steam: every kind of matter that is drawn differently.
inline Snapshot everything() {
  Snapshot s;
  s.materialLook = {{0.75f, 0.87f, 0.98f, 1}};
  uint32_t id = 0;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      for (int k = 0; k < 8; ++k)
        addParticle(s, {i * 0.02 - 0.07, 0.05 + j * 0.02, k * 0.02 - 0.07}, 0.0124, id++, api::Motion::Solid, 265);
  for (int i = 0; i < 24; ++i)
    for (int k = 0; k < 24; ++k)
      addParticle(s, {i * 0.02 - 0.23, 0.01, k * 0.02 - 0.23}, 0.0124, id++, api::Motion::Liquid, 300 + i);
  for (int i = 0; i < 60; ++i)
    addParticle(s, {0.15 * std::sin(i), 0.25 + 0.008 * i, 0.15 * std::cos(2.1 * i)}, 0.017, id++, api::Motion::Gas,
                374);
  for (int i = 0; i < 10; ++i) addParticle(s, {0.3, 0.01, i * 0.02 - 0.1}, 0.0124, id++, api::Motion::Static);
  return s;
}

}  // namespace ps::testing
