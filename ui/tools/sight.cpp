// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/sight.h"

#include <utility>

namespace ps {

void Sight::show(SnapshotPtr scene) {
  const std::lock_guard lock(m_shown->mutex);
  m_shown->scene.swap(scene);  // what was shown goes beyond the lock
}

MatterWithin Sight::matterWithin() const {
  return [shown = m_shown](const Vector3& centre, double radius) {
    SnapshotPtr scene;
    {
      const std::lock_guard lock(shown->mutex);
      scene = shown->scene;
    }
    return scene ? seenIn(*scene, centre, radius) : SeenMatter{};
  };
}

SeenMatter seenIn(const Snapshot& scene, const Vector3& centre, double radius) {
  SeenMatter seen;
  for (size_t i = 0; i < scene.position.size(); ++i) {
    const Vector3 place = imageNear(scene.period, vectorOf(scene.position[i]), centre);
    if (!((place - centre).squaredNorm() <= radius * radius)) continue;
    seen.position.push_back(float4Of(place, scene.position[i].w));
    seen.temperature.push_back(scene.temperature[i]);
    seen.speed.push_back(scene.speed[i]);
    seen.phase.push_back(scene.phase[i]);
    seen.motion.push_back(scene.motion[i]);
    seen.body.push_back(scene.body[i]);
    seen.material.push_back(scene.material[i]);
  }
  return seen;
}

}  // namespace ps
