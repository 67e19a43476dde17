// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/handbrush.h"
#include "ui/tools/leading.h"

#include <optional>
#include <string>

namespace ps {

class Toolbox;

/// A hand in the scene that holds a body as TakeInHand does with a pointer: it goes where the hand goes, and turns with
/// it. From being taken to being let go is one step of undo,
/// unless the other hand ends a stroke meanwhile.
class HandTool {
 public:
  explicit HandTool(Toolbox& box) : m_box(box) {}
  /// Whether there is something at the hand to be taken; then it is. `scene`: as it is shown; nullptr: nothing yet.
  /// `leavesFree`: solid matter that is nearer, and free, is meant for another way of holding it.
  bool take(const HandInScene& hand, const SnapshotPtr& scene, bool leavesFree);
  /// Where nobody knows the hand's place the body stays meanwhile. It is let go by itself where it is gone.
  void follow(const HandInScene& hand);
  void letGo();
  /// The same, where it stood: it was not meant.
  void putBack();
  double since() const { return m_grip->seconds; }  ///< s, on the hand's clock, when it was taken; while active
  bool active() const { return m_grip.has_value(); }
  const std::string& body() const { return m_grip->before.id; }  ///< while active

 private:
  struct Grip {
    Body before;         ///< as it stood when it was taken
    Vector3 taken;       ///< m, where the hand was then,
    Matrix3 turned;      ///< and how it was turned
    uint64_t begun = 0;  ///< Document::changeCount() before
    double seconds = 0;
  };
  Toolbox& m_box;
  std::optional<Grip> m_grip;
};

}  // namespace ps
