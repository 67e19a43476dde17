// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/paintedscene.h"

#include <map>
#include <string>

namespace ps {

/// How a stay in the headset went.
struct Stay {
  std::optional<vr::Ending> ending;  ///< nothing where it lasted longer than a test waits
  uint64_t frames = 0;
  double hertz = 0;  ///< of the headset, when it ended
  SceneRecord record;
};

/// What a test does in frames, by their number from 0.
struct StayPlan {
  size_t leaveAfter = 20;  ///< frames that were drawn
  PaintedScene::Before before = [](size_t) { return std::array<std::optional<vr::Vibration>, 2>{}; };
};

/// Enters the headset with a context, which must not be current, and waits for the end.
Stay stayInHeadset(const std::function<void()>& makeCurrent, const std::function<void()>& release,
                   const StayPlan& plan = {});
Stay stayInHeadset(HeadlessContext& context, const StayPlan& plan = {});

/// How many objects of each kind exist in the context that is current, and of all kinds.
std::map<std::string, size_t> glObjects();
size_t countGlObjects();
size_t countThreads();  ///< of this process

}  // namespace ps
