// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"

#include <atomic>
#include <memory>

namespace ps {

/// Names the matter of one edit for as long as somebody may undo or redo it.
using MatterRef = std::shared_ptr<const MatterKey>;

inline MatterRef newMatter() {
  static std::atomic<MatterKey> last{0};
  return std::make_shared<const MatterKey>(++last);
}

}  // namespace ps
