// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "core/sketch/nearmatter.h"

#include <memory>
#include <mutex>

namespace ps {

/// What a brush sees of the scene while a hand draws: whoever feeds the hand shows it, and the thread that asks the
/// brush looks at the last one shown.
class Sight {
 public:
  void show(SnapshotPtr scene);
  /// Goes on seeing what is shown as long as this lives, and then the last of it.
  MatterWithin matterWithin() const;

 private:
  struct Shown {
    std::mutex mutex;
    SnapshotPtr scene;
  };
  std::shared_ptr<Shown> m_shown = std::make_shared<Shown>();
};

/// Matter of a scene within a radius (m) of a place; in a periodic box its nearest images.
SeenMatter seenIn(const Snapshot& scene, const Vector3& centre, double radius);

}  // namespace ps
