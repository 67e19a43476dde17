// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/solver/report.h"

#include <cstdint>
#include <string>

namespace ps {

/// What an engine's thread has to tell. The newest one stands until another follows.
struct EngineEvent {
  enum class Kind {
    Step,       ///< a step raised flags
    Refused,    ///< an edit was refused and has changed nothing
    NotOpened,  ///< a project could not be built; there is no scene
    Stopped,    ///< something failed between two frames or in one; the scene is paused
    Remark,     ///< something of what was opened; all goes on
    Settled,    ///< what was reported last no longer holds
  };
  uint64_t number = 0;  ///< counts the thread's events
  Kind kind = Kind::Step;
  StepFlags flags = 0;  ///< of steps; PluginFault of edits that a plugin failed in
  std::string message;
};

}  // namespace ps
