// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>
#include <QtCore/QTimer>

#include <cstdint>
#include <memory>

class QAction;

namespace ps {

struct Props;

namespace vr {
class Headset;
class HeadsetLink;
class Mirror;
struct Ending;
}  // namespace vr

class Actions;
class CurveTarget;
class Notices;
class Session;
class StatusLine;
class Toolbox;
class Viewport;
class VrHands;
class VrMirror;
class VrPanels;
class VrWithout;

/// The stay in a headset, or in a window in its place: an action enters and leaves it. It shows there what the view
/// shows, and hands work there with the editor's brush; the run goes on as it is. Nothing here waits for the headset's
/// thread, which starts and ends the stay by itself; only when this object goes during a stay does it wait until that
/// is left, or for seconds where the headset's software does not answer.
class VrMode : public QObject {
  Q_OBJECT
 public:
  /// `view`: nullptr where there is no picture. All must outlive it.
  struct Parts {
    Session& session;
    Viewport* view;
    Toolbox& tools;
    Notices& notices;
    StatusLine& status;
    CurveTarget& curves;
    const Actions& actions;  ///< "simulation.vr", "simulation.tryVr" and "simulation.mirror" among them
  };
  explicit VrMode(const Parts& parts);
  ~VrMode() override;

  void enter();
  void enterWithout();  ///< in a window in which mouse and keys are head and hands
  void leave();
  bool active() const { return m_link != nullptr; }
  uint64_t frames() const;  ///< that the headset got in this stay, or the window
  VrWithout* window() const { return m_window; }
  VrMirror* mirror() const { return m_mirror.get(); }  ///< nullptr: the window shows the view
  VrPanels* panels() const { return m_panels.get(); }  ///< nullptr: nobody is in VR

 Q_SIGNALS:
  void ended(const QString& sentence);  ///< "": as it was asked for here
  // As those of VrPanels.
  void wayOutWanted(const QString& link);
  void refused(const QString& title, const QString& why);

 private:
  void follow();
  void begin();
  void look();
  void useHands();
  void show();
  void showHands();  ///< they alone have changed
  void showHandsOutside();
  void takeHandsOutside();
  void end(const vr::Ending& ending);
  QString hindrance() const;
  void showState();
  void offerTrial(const QString& why);
  void showMirror();

  const Parts m_parts;
  QAction &m_action, &m_without, &m_mirrors;  ///< by a headset, and without one; what the window shows meanwhile
  std::shared_ptr<vr::HeadsetLink> m_link;
  std::unique_ptr<VrHands> m_hands;
  std::shared_ptr<VrPanels> m_panels;  ///< of a stay; a menu that is open there keeps them until it closes
  std::unique_ptr<vr::Headset> m_headset;
  std::shared_ptr<vr::Mirror> m_pictures;
  std::unique_ptr<VrMirror> m_mirror;
  VrWithout* m_window = nullptr;
  bool m_leaving = false;
  bool m_triesNext = false;   ///< VR without a headset was asked for, and a stay in one has yet to end
  bool m_entersNext = false;  ///< the headset was asked for again, while a stay in it has yet to end
  QTimer m_timer{this};
  bool m_changed = false;  ///< there is something else to show
  QElapsedTimer m_sinceShown, m_sinceHands, m_sinceOutside;
  std::shared_ptr<const Props> m_outside;  ///< hands that the view shows; nullptr: none
  uint64_t m_picture = 0, m_looks = 0;
  uint64_t m_project = 1;  ///< counts those that were shown
};

}  // namespace ps
