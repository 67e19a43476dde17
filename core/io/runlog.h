// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/runrecord.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <map>
#include <memory>
#include <vector>

// The log of a run as JSON: what was edited, and after which frame. Private to this room.
namespace ps {

class PluginRegistry;

/// By the number that edits give them.
using Documents = std::map<uint64_t, std::shared_ptr<const Project>>;

/// The edits as a list; where one is of the whole document, `numberOf` says which.
nlohmann::json logOf(const FrameEdit* first, const FrameEdit* end,
                     const std::function<uint64_t(const std::shared_ptr<const Project>&)>& numberOf);
/// Throws InputError for whatever is none. `before`: the edits of the run until there, of whose documents bodies take
/// their meshes. Keys of matter are moved out of the way of those that this program gives.
std::vector<FrameEdit> readLog(nlohmann::json list, const Documents& documents, const std::vector<FrameEdit>& before,
                               const PluginRegistry& plugins);

/// What a key of a file is here.
MatterKey keyHere(uint64_t key);
/// What an edit names; 0: nothing.
MatterKey keyOf(const RecordedEdit& edit);

}  // namespace ps
