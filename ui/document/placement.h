// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <string>
#include <vector>

namespace ps {

/// The boxes that hold a body's matter (Body::pins), all of them, and which are meant.
struct BodyPins {
  std::string id;  ///< Body::id
  std::vector<Region> boxes;
  std::vector<size_t> chosen{};  ///< indices of those that are put elsewhere
};

/// Things of a scene that have a place, as values: those that are put somewhere together. Of bodies shape, pins and
/// what varies along them counts, of the others all.
struct Placement {
  std::vector<Body> bodies;
  std::vector<Emitter> emitters;
  std::vector<Sink> sinks;
  std::vector<SceneWall> walls;
  std::vector<Probe> probes;
  std::vector<BodyPins> pins{};  ///< of bodies that are not among those above
  bool led = false;              ///< bodies go there by a hand, as time passes, and meet what is in their way
  bool empty() const {
    return bodies.empty() && emitters.empty() && sinks.empty() && walls.empty() && probes.empty() && pins.empty();
  }
};

/// How the things of a scene stand in lists, by their ids, and which of them are grouped.
struct SceneOrder {
  std::vector<SceneGroup> groups;
  std::vector<std::string> bodies, emitters, sinks, walls, probes;
  bool operator==(const SceneOrder&) const = default;
};

}  // namespace ps
