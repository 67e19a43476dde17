// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/stand.h"

#include <algorithm>
#include <cmath>

namespace ps::vr {
namespace {

constexpr double kSmallest = 0.1, kLargest = 1.2;  // m, of what stands on a table
constexpr double kStretch = 20;                    // how many times as large, or as small, hands may make it
constexpr double kUpright = 0.3;                   // share of a way that is level, below which it counts as upright
constexpr double kBelowEyes = 0.55;                // m, of the table's top
constexpr double kBefore = 0.3;                    // m from the eyes to the nearest of the scene

Matrix3 about(double angle) { return Eigen::AngleAxisd(angle, Vector3::UnitY()).toRotationMatrix(); }

}  // namespace

Vector3 Stand::toScene(const Vector3& room) const { return scenePlace + about(-turn) * (room - roomPlace) / scale; }
Vector3 Stand::toRoom(const Vector3& scene) const { return roomPlace + scale * (about(turn) * (scene - scenePlace)); }

HandPose Stand::toScene(const HandPose& room) const {
  return {toScene(room.position), Quaternion(about(-turn)) * room.orientation};
}

Eye Stand::toScene(const Eye& room) const {
  const Matrix3 axes = room.view.topLeftCorner<3, 3>() * about(turn);
  Eye eye = room;
  eye.view.topLeftCorner<3, 3>() = axes;
  eye.view.topRightCorner<3, 1>() = -axes * toScene(placeOf(room));
  eye.projection(2, 3) /= scale;
  return eye;
}

Stand carried(const Stand& before, const std::array<Vector3, 2>& from, const std::array<Vector3, 2>& to) {
  const Vector3 was = from[1] - from[0], is = to[1] - to[0], middle = (from[0] + from[1]) / 2;
  const auto level = [](const Vector3& way) { return std::hypot(way.x(), way.z()) > kUpright * way.norm(); };
  Stand stand = before;
  stand.scenePlace = before.toScene(middle);
  stand.roomPlace = (to[0] + to[1]) / 2;
  // A scene that came to its wearer beyond these stays as it is until it is stretched towards them.
  stand.scale = std::clamp(before.scale * is.norm() / std::max(was.norm(), 1e-3), std::min(before.scale, 1 / kStretch),
                           std::max(before.scale, kStretch));
  // Hands one above the other turn nothing.
  if (level(was) && level(is)) stand.turn += std::atan2(is.x(), is.z()) - std::atan2(was.x(), was.z());
  return stand;
}

Stand turned(const Stand& before, const Vector3& about, double angle) {
  Stand stand = before;
  stand.scenePlace = before.toScene(about);
  stand.roomPlace = about;
  stand.turn += angle;
  return stand;
}

Stand standBefore(const HandPose& head, const Box& box) {
  const Vector3 size = box.second - box.first;
  const double width = std::max({size.x(), size.y(), size.z(), 1e-6});
  Stand stand;
  stand.scale = std::clamp(width, kSmallest, kLargest) / width;
  const Vector3 forward = head.orientation * Vector3(0, 0, -1);
  const bool level = std::hypot(forward.x(), forward.z()) > 1e-3;  // else one looks straight down, or up
  stand.turn = level ? std::atan2(-forward.x(), -forward.z()) : 0;
  stand.scenePlace = (box.first + box.second) / 2;
  stand.scenePlace.y() = box.first.y();
  const double away = kBefore + stand.scale * size.z() / 2;
  stand.roomPlace = head.position + about(stand.turn) * Vector3(0, -kBelowEyes, -away);
  return stand;
}

}  // namespace ps::vr
