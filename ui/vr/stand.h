// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"
#include "ui/render/framing.h"
#include "ui/vr/handinput.h"

#include <array>

namespace ps::vr {

/// How the scene stands in the room: upright, turned, and perhaps larger or smaller than it is.
struct Stand {
  Vector3 scenePlace{0, 0, 0}, roomPlace{0, 0, 0};  ///< m, one and the same place
  double turn = 0;                                  ///< rad about y, of the scene in the room
  double scale = 1;                                 ///< m of the room for each of the scene

  Vector3 toScene(const Vector3& room) const;
  Vector3 toRoom(const Vector3& scene) const;
  HandPose toScene(const HandPose& room) const;
  /// As it sees the scene; its planes are where they are in the room.
  Eye toScene(const Eye& room) const;
};

/// A scene that two hands carry, turn and stretch, from where they took hold of it; it stays upright, and between a
/// twentieth and twenty times as large as it is.
Stand carried(const Stand& before, const std::array<Vector3, 2>& from, const std::array<Vector3, 2>& to);
/// Turned about a place in the room; rad.
Stand turned(const Stand& before, const Vector3& about, double angle);

/// Sets what is in the box before somebody as on a table: within reach, its bottom as far below the eyes as a table is
/// for one who sits and a bench for one who stands. Things have the size that they have, so that hands draw and hold
/// them true to scale; what no table would bear, or nobody would see, is made as small or as large as a table bears.
Stand standBefore(const HandPose& head, const Box& box);

}  // namespace ps::vr
