// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/leading.h"

#include "core/scene/pose.h"
#include "ui/document/declared.h"
#include "ui/document/placement.h"
#include "ui/document/wallside.h"

#include <algorithm>
#include <array>

namespace ps {
namespace {

/// m by which a body is to be put back into a room that it has room in.
Vector3 backInto(const Room& room, const std::array<bool, 3>& periodic, const BodyBounds& bounds) {
  Vector3 back(0, 0, 0);
  for (int a = 0; a < 3; ++a) {
    const double low = room.minimum[a] - bounds.minimum[a], high = room.maximum[a] - bounds.maximum[a];
    if (!periodic[static_cast<size_t>(a)] && low <= high) back[a] = std::clamp(0.0, low, high);
  }
  return back;
}

}  // namespace

const Body* leadable(const Document& document, const Snapshot& scene, size_t particle) {
  if (!scene.bodyIds || scene.motion[particle] != api::Motion::Static) return nullptr;
  const uint32_t index = scene.body[particle];
  if (index >= scene.bodyIds->size()) return nullptr;
  const Body* body = document.body((*scene.bodyIds)[index]);
  if (!body || body->locked || !toggleOf(body->parameters, bodyParameters(), "fixed")) return nullptr;
  return body;
}

Vector3 lead(Document& document, const Body& before, RigidMove move) {
  const Environment& scene = document.project().environment;
  const Vector3 back = backInto(roomOf(scene), scene.periodic, boundsOf(moved(before, move)));
  move.shift += back;
  Placement to;
  to.bodies.push_back(moved(before, possibleMove(before, move)));
  to.led = true;
  document.place(std::move(to), QStringLiteral("moving %1 by hand").arg(nameOf(before)));
  return back;
}

}  // namespace ps
