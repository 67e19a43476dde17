// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/scenewall.h"

#include <string>
#include <vector>

namespace ps {

/// A face of a box, where a wall may stand and look inward.
struct WallSide {
  const char* id;
  const char* name;
  size_t axis;
  bool upper;  ///< at the box' maximum along the axis
};
inline constexpr WallSide kWallSides[] = {
    {"floor", "Floor", 1, false},     {"lid", "Lid", 1, true},    {"left", "Left side", 0, false},
    {"right", "Right side", 0, true}, {"back", "Back", 2, false}, {"front", "Front", 2, true},
};
/// The four that keep matter from running off.
inline const std::vector<std::string> kUprightSides{"left", "right", "back", "front"};

/// A box in m.
struct Room {
  Vector3 minimum, maximum;
};
/// Where matter can be: the scene's bounds, within the walls that stand along them.
Room roomOf(const Environment& environment);

/// A wall that lets no heat through, on that face of the box.
SceneWall wallOn(const WallSide& side, const Vector3& minimum, const Vector3& maximum);

/// A cylinder that stands upright, or a sphere, in the middle of the room, with matter inside and
/// without heat: as wide as the room has space for, or, where there are bodies, so wide that it pushes none of them.
SceneWall roundWall(WallForm form, const Project& project);

}  // namespace ps
