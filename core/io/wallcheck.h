// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <string>
#include <vector>

namespace ps {

struct WallFinding {
  bool refused = true;  ///< else all goes on, and it is told
  std::string pointer;  ///< behind the wall's own: "/normal/0"
  std::string what;
};
/// What of a wall's place and shape cannot be in its project: in a periodic scene what would not meet its own image,
/// and what is too narrow for its particles.
std::vector<WallFinding> findingsOf(const Project& project, const SceneWall& wall);

}  // namespace ps
