// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/livestroke.h"
#include "ui/tools/livetouch.h"

#include <optional>
#include <string>
#include <utility>

namespace ps {

/// A hand in the scene, and how it holds the brush.
struct HandInScene {
  std::optional<Vector3> place;  ///< m, of the brush's middle; nothing while nobody knows where the hand is
  Vector3 up{0, 1, 0};           ///< a unit vector, across what flat brushes draw
  Vector3 forward{0, 0, -1};     ///< a unit vector, along which it points: a blade lies in it
  double pressure = 0;           ///< how far its trigger is pressed, 0..1
  bool opposite = false;         ///< erases, or does the opposite of what the brush is called
  double seconds = 0;            ///< on any clock that runs on
};

/// A hand that has the chosen brush at its tip and draws where it is, instead of pointing at a place: in the air as on
/// matter. What it does is what the tools for pointers do: a stroke, or a hand that touches matter, of one step of
/// undo. There may be several; the stroke of one goes on while that of another ends.
class HandBrush {
 public:
  /// `always`: it has that brush for matter, whatever is chosen, with the size of the chosen one.
  explicit HandBrush(Toolbox& box, std::string always = {})
      : m_box(box), m_always(std::move(always)), m_stroke(box), m_touch(box, [this](const QString& why) { say(why); }) {
    m_stroke.onEnd([this] { endStroke(); });
  }
  /// `scene`: as it is shown; nullptr: nothing yet.
  void follow(const HandInScene& hand, const SnapshotPtr& scene);
  void end();                                   ///< as far as it came; what fills goes on beside it
  void finish();                                ///< at once, with what fills
  bool finishes() const { return m_finishes; }  ///< what changes in the document is the end of its stroke
  void cancel();  ///< gives up what it does; it begins again when its trigger is pressed anew
  bool active() const { return m_stroke.active() || m_touch.active(); }
  bool stands() const { return m_stroke.stands(); }                             ///< LiveStroke::stands()
  bool heats() const { return m_touch.heats(); }                                ///< or cools, now
  double effort(const Snapshot& scene) const { return m_touch.effort(scene); }  ///< N, of a hand in matter there
  uint64_t begun() const { return m_begun; }                                    ///< strokes so far

 private:
  void begin(const HandInScene& hand, const SnapshotPtr& scene);
  void move(const HandInScene& hand);
  BrushSettings brush() const;
  Held heldBy(const HandInScene& hand) const;
  void endStroke();
  void say(const QString& problem, bool kept = false);

  Toolbox& m_box;
  std::string m_always;
  LiveStroke m_stroke;
  LiveTouch m_touch;
  bool m_pressed = false, m_finishes = false;
  HandInScene m_last;     ///< that the stroke got
  Vector3 m_up{0, 1, 0};  ///< of the hand as it began
  double m_began = 0;     ///< s
  uint64_t m_begun = 0;
};

}  // namespace ps
