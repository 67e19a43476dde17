// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/headsetlink.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>
#include <QtCore/QPointF>
#include <QtCore/QPointer>
#include <QtCore/QTimer>

#include <array>
#include <map>
#include <memory>
#include <optional>

class QEvent;
class QWidget;

namespace ps {

class Actions;
class CurveTarget;
class Inspector;
class Session;
class Toolbox;
class Viewport;
class VrBoard;
class VrLabels;
class VrPalette;
struct PanelContext;

/// The interface in the headset: the palette, and the window's own pages on a board, or on panels of their own beside
/// it, painted where no screen shows them. Hands that point at them act as a mouse does; a menu that opens there comes
/// along.
class VrPanels : public QObject {
  Q_OBJECT
 public:
  struct Parts {
    Session& session;
    Toolbox& tools;
    CurveTarget& curves;
    Viewport* view;
    const Actions& actions;
  };
  explicit VrPanels(const Parts& parts);
  ~VrPanels() override;

  void act(const vr::HandsSeen& seen);
  void letGo();
  /// Sets the board before the wearer, or puts it away where they have it before them.
  void toggleBoard();
  /// On the panel of its own that it may have, or on the board.
  void showPage(const QString& title);
  /// What the controllers' parts do: of themselves for the first two minutes, then where they are asked for.
  void showLabels(bool shown);
  bool showsLabels() const { return m_labelsShown; }
  /// Whether the wearer would see something else by now. Paints that.
  bool paint();
  void describe(vr::HeadsetView& view) const;
  QWidget* widget(size_t panel) const;  ///< nullptr: it is not there

 Q_SIGNALS:
  void wayOutWanted(const QString& link);                  ///< see ui/panels/wayout.h
  void refused(const QString& title, const QString& why);  ///< "" for `why`: what was is over; the board says it too

 private:
  /// A hand as a mouse.
  struct Pointer {
    QPointer<QWidget> on, under, grabs;  ///< a panel, what is there of it, and what is pressed
    QPointF at;                          ///< of the panel
    bool pressed = false, asks = false;  ///< the latter: for a menu already
    double scrolled = 0;                 ///< s, when it scrolled last
    std::optional<double> pressedSince;  ///< s, on the headset's clock; nothing after a double press
    QPointF pressedAt;
    uint64_t ticks = 0;
  };
  // vrpanelhands.cpp
  void follow(Pointer& pointer, const std::optional<vr::PanelPoint>& point, double seconds);
  QWidget* aimedAt(Pointer& pointer);
  void enter(Pointer& pointer, QWidget* under);
  void press(Pointer& pointer, double seconds);
  void release(Pointer& pointer);
  void openMenu(Pointer& pointer);
  void scroll(Pointer& pointer, double way, double seconds);
  void leave(Pointer& pointer);
  void letGoOf(const QWidget& page);
  void send(const Pointer& pointer, QWidget& target, int type, Qt::MouseButton button);
  void deliver(QWidget& target, QEvent& event);
  // vrpanels.cpp
  QWidget* makePage(const QString& title);
  void makeInspector();
  void connectPage(QWidget& page);
  void makeBoards();
  size_t boardOf(const QWidget& page) const;
  void setBeside();
  void putAway(size_t board);
  void putBack(size_t board);
  void move(QWidget& page, size_t board);
  size_t panelOf(const QWidget& widget) const;
  void note(const QString& title, const QString& why);
  void refuse(const QString& title, const QString& why);
  void showCurve();
  void findPopup();
  bool mayWait(size_t panel) const;
  void measure(size_t panel, const QWidget& shown);
  bool paintLabels();

  const Parts m_parts;
  std::unique_ptr<Inspector> m_inspector;  ///< of the board alone, once a page is asked for
  std::unique_ptr<VrPalette> m_palette;
  std::array<std::unique_ptr<VrBoard>, vr::kBoards> m_boards;
  std::map<QString, QWidget*> m_made;
  std::array<bool, vr::kBoards> m_shown{}, m_ahead{true, true, true};
  std::array<uint64_t, vr::kBoards> m_brought{};
  int64_t m_turns = 0;  ///< of the wearer, to the right, that were asked for
  std::array<Pointer, 2> m_pointers;
  std::array<vr::PanelView, vr::kPanels> m_painted;
  std::array<std::unique_ptr<VrLabels>, 2> m_labels;
  std::array<vr::PanelView, 2> m_paintedLabels;
  bool m_labelsShown = true;
  QTimer m_labelsEnd;  ///< of the first two minutes
  QTimer m_noteEnds;
  QElapsedTimer m_sincePaint, m_sinceRest;  ///< the latter: of panels that nobody points at
  bool m_touched = true;                    ///< something was pressed or pointed at since it was painted
  bool m_ticked = false;                    ///< something is to be felt
  QPointer<QWidget> m_popup;                ///< that came of what hands do here
  size_t m_popupOn = vr::kBoard;
  int m_delivering = 0;              ///< events: a menu may wait in one until it closes
  const Pointer* m_sends = nullptr;  ///< whose press, move or release that is; nullptr: of none
  uint64_t m_acts = 0;
};

}  // namespace ps
