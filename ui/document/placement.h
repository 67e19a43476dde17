// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <string>
#include <vector>

namespace ps {

/// Things of a scene that have a place, as values: those that are put somewhere together. Of bodies shape, pins and
/// what varies along them counts, of the others all.
struct Placement {
  std::vector<Body> bodies;
  std::vector<Emitter> emitters;
  std::vector<Sink> sinks;
  std::vector<SceneWall> walls;
  std::vector<Probe> probes;
  bool empty() const { return bodies.empty() && emitters.empty() && sinks.empty() && walls.empty() && probes.empty(); }
};

/// How the things of a scene stand in lists, by their ids, and which of them are grouped.
struct SceneOrder {
  std::vector<SceneGroup> groups;
  std::vector<std::string> bodies, emitters, sinks, walls, probes;
  bool operator==(const SceneOrder&) const = default;
};

}  // namespace ps
