// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/solver/report.h"

#include <cstdint>
#include <optional>
#include <string>

namespace ps {

/// What an engine's thread has to tell. The newest one stands until another follows.
struct EngineEvent {
  enum class Kind {
    Step,       ///< a step raised flags
    Refused,    ///< an edit was refused and has changed nothing
    NotOpened,  ///< a project could not be built; there is no scene
    Cancelled,  ///< making a scene was; there is none, or the one before goes on
    Stopped,    ///< something failed between two frames or in one; the scene is paused
    Late,       ///< a plugin, whose id is the message, has not come back from a call for long; Settled when it has
    Remark,     ///< something of what was opened; all goes on
    Settled,    ///< what was reported last no longer holds
  };
  uint64_t number = 0;  ///< counts the thread's events
  Kind kind = Kind::Step;
  StepFlags flags = 0;  ///< of steps; PluginFault of edits that a plugin failed in
  std::string message;
  /// Whose value is to blame, where that is known: why there is no scene, or the parameter that an edit would have set.
  std::optional<Address> culprit{};
  std::optional<Value> asked{}, kept{};  ///< of such an edit; kept: storedValue() of what goes on
};

}  // namespace ps
