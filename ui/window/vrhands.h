// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/changeevent.h"
#include "ui/tools/handbrush.h"
#include "ui/tools/handtool.h"
#include "ui/vr/headsetlink.h"

#include <QtCore/QObject>

#include <array>
#include <optional>
#include <string>
#include <utility>

namespace ps {

class Session;

/// What hands in the headset do in the editor: the main one draws with the chosen brush, the other one erases with it,
/// or each does what the other does while its grip is held. Either takes hold of what is there (of a body that is held
/// in place, to lead it, or of free matter while time passes), and buttons undo, play, and choose size, shape and
/// material.
class VrHands : public QObject {
  Q_OBJECT
 public:
  /// Both must outlive it.
  VrHands(Session& session, Toolbox& tools);
  /// `scene`: as it is shown.
  void act(const vr::HandsSeen& seen, const SnapshotPtr& scene);
  void letGo();  ///< of everything: strokes end as far as they came
  /// What each hand holds, for the headset to draw, and how many strokes it has begun.
  void describe(vr::HeadsetView& view);
  bool changed() const { return m_changed; }  ///< since it was described last

 Q_SIGNALS:
  void boardWanted();
  void realWanted();  ///< what is held shall be let go

 private:
  bool ends() const;
  void onChanged(const ChangeEvent& event);
  void finishStrokes();
  void draw(size_t hand, const vr::HandsSeen& seen, const SnapshotPtr& scene);
  bool lead(size_t hand, const HandInScene& there, bool carries, const SnapshotPtr& scene);
  bool grab(size_t hand, HandInScene there, const SnapshotPtr& scene);
  bool meets(const HandInScene& there, const SnapshotPtr& scene) const;
  vr::Feeling feeling(size_t hand, const Snapshot* scene) const;
  void press(size_t hand, const vr::HandRoles& roles, const vr::HandInput& now, double seconds);
  std::pair<bool, bool> pressed(size_t hand, const vr::HandInput& now, double seconds);
  void choose(const vr::HandInput& now, double seconds);
  void step(int direction, double seconds);
  std::array<float, 3> colour(size_t hand, const vr::HandRoles& roles, const Snapshot* scene) const;

  Session& m_session;
  Toolbox& m_tools;
  std::array<HandBrush, 2> m_brushes, m_grabs;
  std::array<HandTool, 2> m_held;
  std::array<uint64_t, 2> m_taken{};                  ///< bodies so far
  vr::HandsSeen m_seen;                               ///< the last one
  std::array<Vector3, 2> m_described;                 ///< how brushes were turned then
  std::optional<double> m_stepped;                    ///< s, when what is still pushed gave the brush another size
  std::array<std::optional<double>, 2> m_firstSince;  ///< s, of a hand with one button for both
  bool m_ends = false;                                ///< what changes in the document is the end of a stroke here
  bool m_edited = false;                              ///< by somebody else since they acted last
  bool m_changed = false;
};

}  // namespace ps
