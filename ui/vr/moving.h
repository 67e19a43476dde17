// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"
#include "ui/vr/headset.h"
#include "ui/vr/stand.h"

#include <array>
#include <memory>
#include <optional>

namespace ps::vr {

/// How the scene stands in the room, and how its wearer changes that: both grips carry it, unless one has had something
/// in it before the other came; the main stick aside turns it about them by 30 degrees, which eyes bear better than a
/// turn; and the other one forward takes them to where that hand points on the floor as soon as it is let go. A hand
/// that is alone does that with its grip pressed, and so makes the scene larger or smaller by its stick aside. A bare
/// hand points there with its index, and then pinches. While it moves the edge of what is seen is dimmed.
class Moving {
 public:
  const Stand& stand() const { return m_stand; }
  void place(const Stand& stand) {
    m_stand = stand;
    m_carrying.reset();  // it goes on from there
  }
  /// `busy`: the hand that goes has another use for its stick. `keeps`: which hands have something in them.
  void follow(const HeadsetFrame& frame, const HandRoles& roles = {}, bool busy = false,
              const std::array<bool, 2>& keeps = {});
  /// Its wearer at a place of the room, by so many steps of 30 degrees to the right.
  void turnBy(int64_t steps, const Vector3& about);
  bool carries() const { return m_carrying.has_value(); }
  /// It carries, or has not been let go since: it takes nothing else.
  bool usesGrip(size_t hand) const { return m_usesGrip[hand]; }
  /// m on the floor, where the wearer will be.
  const std::optional<Vector3>& goal() const { return m_goal; }
  /// Its pinch is none of the brush's business: it says go.
  bool takes(size_t hand) const { return hand == m_roles.goes() && (m_goes || (m_goal && m_pointed)); }
  /// Its stick is none of the brush's business: that of a hand that is alone, with its grip pressed.
  bool steers(size_t hand, const HandInput& input) const {
    return m_roles.alone && hand == m_roles.main && isGripped(input);
  }
  bool dims() const { return m_dimmed > 0; }
  /// The way to the goal, and what dims. Comes last: that lies before all else.
  void addTo(Props& props, const HeadsetFrame& frame, const std::array<float, 3>& accent) const;

 private:
  void carry(const HeadsetFrame& frame, const std::array<bool, 2>& keeps);
  static bool isGripped(const HandInput& input);
  void turn(const HeadsetFrame& frame, bool busy);
  void scaleBy(double factor, const HeadsetFrame& frame);
  void go(const HeadsetFrame& frame, bool busy);
  void goBare(const HeadsetFrame& frame, const std::optional<Vector3>& goal);
  void arriveAt(const Vector3& goal, const HeadsetFrame& frame);

  Stand m_stand;
  HandRoles m_roles;
  /// By both hands, from when they took hold of the scene.
  struct Carrying {
    Stand from;
    std::array<Vector3, 2> hands;  ///< m, in the room
  };
  std::optional<Carrying> m_carrying;
  std::array<bool, 2> m_usesGrip{};
  std::array<std::optional<double>, 2> m_gripped;  ///< s, since when
  bool m_turns = false;                            ///< asked for already
  std::optional<Vector3> m_goal;
  std::optional<double> m_pointed;  ///< s, when a bare hand pointed at the goal last
  bool m_goes = false;              ///< by a pinch that lasts
  double m_dimmed = 0;              ///< s, for which it stays so
};

}  // namespace ps::vr
