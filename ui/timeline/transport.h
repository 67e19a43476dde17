// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "ui/document/changeevent.h"

#include <QtWidgets/QWidget>

class QLabel;
class QPushButton;
class QToolButton;

namespace ps {

class Session;
class ThermalClock;

/// "Heat ×2000 = ", "2 h 20 min", " of real heating"; all empty while heat keeps real time.
struct ThermalTexts {
  QString before, span, after;
  QString whole() const { return before + span + after; }
  double width() const;                     ///< logical pixels
  ThermalTexts fitting(double room) const;  ///< without what has no room, the span last
};

/// Reset, step, play; the two clocks; how much of the planned duration has passed.
class Transport : public QWidget {
  Q_OBJECT
 public:
  explicit Transport(Session& session, QWidget* parent = nullptr);
  void setPlaying(bool playing);
  void setReady(bool ready);
  void setDuration(double seconds);
  void setStateTime(double seconds);  ///< of the state that the project opens at; 0: it opens at its start
  void setTimeScale(double scale);    ///< thermal seconds per mechanical second
  void setSnapshot(const SnapshotPtr& snapshot);
  QString durationText() const;  ///< "/ 01:00", and what goes on from there while it stands at the end
  QString timeText() const;
  ThermalTexts thermalTexts() const;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void onChanged(const ChangeEvent& event);
  void showTimeScale();
  void refresh();
  void styleButtons();
  Session& m_session;
  QToolButton *m_reset, *m_step;
  QPushButton* m_play;
  QLabel *m_time, *m_duration;
  ThermalClock* m_thermal;
  bool m_playing = false;
  double m_seconds = 0, m_thermalSeconds = 0, m_total = 60, m_scale = 1, m_stateSeconds = 0;
};

}  // namespace ps
