// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/framing.h"
#include "ui/render/renderer.h"

#include <memory>
#include <mutex>

namespace ps::vr {

/// What the editor shows at a time.
struct HeadsetView {
  SnapshotPtr matter;   ///< nullptr: nothing yet
  bool goesOn = false;  ///< from the matter before: what is seen moves from there
  RenderScene scene;
  Look look;
  uint64_t project = 0;  ///< with another one the scene is set before its wearer anew
  Box box;               ///< m, around all that there is to see of the project when it came
};

/// Between the interface's thread and the headset's. What is handed over nobody changes any more; neither waits for
/// longer than it takes to copy a pointer or a few numbers.
class HeadsetLink {
 public:
  void show(std::shared_ptr<const HeadsetView> view) {
    const std::lock_guard lock(m_mutex);
    m_view.swap(view);  // the one before goes after the lock
  }
  std::shared_ptr<const HeadsetView> shown() const {
    const std::lock_guard lock(m_mutex);
    return m_view;
  }

 private:
  mutable std::mutex m_mutex;
  std::shared_ptr<const HeadsetView> m_view;
};

}  // namespace ps::vr
