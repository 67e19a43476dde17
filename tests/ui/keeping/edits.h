// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <cmath>

namespace ps {

/// The floor's temperature counts edits: 300 K before the first one.
inline double kelvinOf(int edit) { return 300 + edit * 0.001; }

inline int editOf(const Project& project) {
  for (const SceneWall& wall : project.environment.walls) {
    const auto found = wall.parameters.values.find("temperature");
    if (wall.id == "floor" && found != wall.parameters.values.end())
      return static_cast<int>(std::lround((std::get<double>(found->second) - 300) * 1000));
  }
  return -1;
}

}  // namespace ps
