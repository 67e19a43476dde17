// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "ui/document/changeevent.h"
#include "ui/timeline/timeaxis.h"

#include <QtWidgets/QWidget>

class QLabel;
class QMenu;
class QPushButton;
class QToolButton;

namespace ps {

class RunLines;
class Session;
class ThermalClock;

/// "Heat ×2000 = ", "2 h 20 min", " of real heating"; all empty while heat keeps real time.
struct ThermalTexts {
  QString before, span, after;
  QString whole() const { return before + span + after; }
  double width() const;                     ///< logical pixels
  ThermalTexts fitting(double room) const;  ///< without what has no room, the span last
};

/// What points at it: a hand in a headset needs larger targets than a mouse.
enum class PointedBy { Mouse, Hand };
/// Height and width of what a hand meets at least, in logical pixels: 2.5 degrees on the board in a headset.
inline constexpr int kHandLeast = 26;

/// Reset, steps, play, loop, speed; the two clocks; below them the part of the planned duration that is recorded, in
/// which a drag shows any frame, and above that the earlier runs. While one is shown it says so, and from where the run
/// goes on.
class Transport : public QWidget {
  Q_OBJECT
 public:
  explicit Transport(Session& session, PointedBy by = PointedBy::Mouse, QWidget* parent = nullptr);
  void setPlaying(bool playing);
  void setReady(bool ready);
  void setDuration(double seconds);
  void setStateTime(double seconds);  ///< of the state that the project opens at; 0: it opens at its start
  void setTimeScale(double scale);    ///< thermal seconds per mechanical second
  void setSnapshot(const SnapshotPtr& snapshot);
  /// "/ 01:00", and what begins a run where none is recorded, what goes on from there while it stands at the end, or
  /// from where while a recorded frame is shown.
  QString durationText() const;
  QString timeText() const;
  ThermalTexts thermalTexts() const;
  QPushButton* continueButton() const { return m_continue; }
  QToolButton* loopButton() const { return m_loop; }
  QToolButton* speedButton() const { return m_speed; }  ///< its menu has the speeds
  /// What can be done with the frame that is shown, and with earlier runs.
  void fillMenu(QMenu& menu);
  QPoint placeOf(double seconds) const;  ///< on the bar
  RunLines* runs() const { return m_runs; }

  /// Where its bar begins and ends, as what lies below does.
  void setAxis(TimeAxis axis);

 Q_SIGNALS:
  void heightChanged();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void changeEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  struct Sizes;
  static const Sizes& sizesOf(PointedBy by);
  void layOut(PointedBy by);
  void onChanged(const ChangeEvent& event);
  void showTimeScale();
  void connectParts();
  void makeSpeeds();
  void showPace();
  void showRecorded();
  void placeRuns();
  void makeRoom();  ///< for the lines of earlier runs
  void refresh();
  void styleButtons();
  double span() const;       ///< s, from the left end of the bar to the right one
  double perSecond() const;  ///< logical pixels
  void scrub(double x);
  Session& m_session;
  const Sizes& m_sizes;
  QToolButton *m_reset, *m_step, *m_back, *m_loop, *m_speed;
  QPushButton *m_play, *m_continue;
  QLabel *m_time, *m_duration;
  ThermalClock* m_thermal;
  RunLines* m_runs;
  TimeAxis m_axis;
  bool m_playing = false, m_scrubs = false;
  double m_seconds = 0, m_thermalSeconds = 0, m_total = 60, m_scale = 1, m_stateSeconds = 0;
};

}  // namespace ps
