// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/camera.h"
#include "ui/vr/headset.h"

namespace ps::vr {

/// A head and two hands in a room, for whoever has no headset: a pointer moves the hand in use, which stays where it is
/// seen while the head turns; the other one stays where it is in the room. What comes of them are frames as of a
/// headset.
class SimulatedRoom {
 public:
  SimulatedRoom();
  /// `seconds`: on a clock that runs on; `aspect`: width of the picture by its height.
  HeadsetFrame frame(double seconds, double aspect);
  HandPose pointer(double aspect) const;  ///< from the eyes, to where the hand in use is seen
  /// m from the eyes, beyond which the hand in use does not go from now on: a panel is there, to be pointed at.
  void keepBefore(std::optional<double> metres) { m_most = metres; }
  Eye eye(double aspect) const;         ///< in the room
  void turn(double right, double up);   ///< rad, of the head
  void walk(const Vector3& way);        ///< m to the right, up, and on the level to where it looks
  void point(double right, double up);  ///< -1..1 across the eye's picture
  void reach(double more);              ///< m, from the eyes
  void roll(double right);              ///< rad, of the hand in use about where it points
  void level();                         ///< that hand is turned so no more
  /// From now on; another main hand is the one in use.
  void give(const HandRoles& roles);
  const HandRoles& roles() const { return m_roles; }
  void useOther() { m_used = 1 - m_used; }
  size_t used() const { return m_used; }
  HandInput& input(size_t hand) { return m_hands.at(hand); }  ///< what it presses

 private:
  HandPose head() const;
  void rest();

  Vector3 m_place{0, 1.6, 0};
  double m_right = 0, m_up = -0.45;  // rad
  double m_x = 0, m_y = 0;           // where the hand in use is seen
  std::array<double, 2> m_reach{0.55, 0.55};
  std::array<double, 2> m_roll{};  // rad, to the right
  std::optional<double> m_most;
  std::array<HandInput, 2> m_hands;
  HandRoles m_roles;
  size_t m_used = kRight;
  double m_before = 0;  // s, of the last frame
};

}  // namespace ps::vr
