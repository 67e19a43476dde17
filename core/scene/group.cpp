// SPDX-License-Identifier: Apache-2.0
#include "core/scene/group.h"

#include <algorithm>
#include <set>

namespace ps {

std::string memberOf(Owner owner, const std::string& id) { return std::string(ownerName(owner)) + "/" + id; }

std::vector<SceneGroup> livingGroups(const Project& project) {
  std::set<std::string> there;
  for (const Body& body : project.bodies) there.insert(memberOf(Owner::Body, body.id));
  for (const Emitter& emitter : project.emitters) there.insert(memberOf(Owner::Emitter, emitter.id));
  for (const Sink& sink : project.sinks) there.insert(memberOf(Owner::Sink, sink.id));
  for (const SceneWall& wall : project.environment.walls) there.insert(memberOf(Owner::Wall, wall.id));
  for (const Probe& probe : project.probes) there.insert(memberOf(Owner::Probe, probe.id));
  std::vector<SceneGroup> groups;
  for (SceneGroup group : project.groups) {
    std::erase_if(group.members, [&](const std::string& member) { return there.erase(member) == 0; });
    if (!group.members.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace ps
