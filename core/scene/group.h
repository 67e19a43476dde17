// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <string>
#include <vector>

namespace ps {

/// Whose things may be in groups.
inline constexpr Owner kMembers[] = {Owner::Body, Owner::Emitter, Owner::Sink, Owner::Wall, Owner::Probe};
/// A thing as groups name it: "body/ice".
std::string memberOf(Owner owner, const std::string& id);
/// The groups with those of their members that the project has; those without any are left out. What has been deleted
/// may come back by undo, and is in its group again then.
std::vector<SceneGroup> livingGroups(const Project& project);

}  // namespace ps
