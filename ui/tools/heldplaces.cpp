// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/heldplaces.h"

#include <algorithm>

namespace ps {

std::vector<Vector3> heldPlaces(const Project& project, const Selection& selection, const Snapshot& now) {
  std::vector<Vector3> places;
  if (!now.bodyIds) return places;
  std::vector<char> shown(now.bodyIds->size(), 0);
  for (size_t b = 0; b < shown.size(); ++b) {
    const std::string& id = (*now.bodyIds)[b];
    const auto body =
        std::find_if(project.bodies.begin(), project.bodies.end(), [&](const Body& one) { return one.id == id; });
    if (body == project.bodies.end() || !body->visible || !selection.has(OutlineKind::Body, id)) continue;
    const auto is = [&](const char* key) { return toggleOf(body->parameters, bodyParameters(), key); };
    shown[b] = !is("fixed") && !is("held") ? 1 : 0;
  }
  if (std::find(shown.begin(), shown.end(), 1) == shown.end()) return places;
  for (size_t i = 0; i < now.position.size(); ++i) {
    if (now.body[i] < shown.size() && shown[now.body[i]] && now.motion[i] == api::Motion::Static)
      places.push_back({now.position[i].x, now.position[i].y, now.position[i].z});
  }
  return places;
}

}  // namespace ps
