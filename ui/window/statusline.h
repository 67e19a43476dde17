// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "ui/document/changeevent.h"
#include "ui/session/messagelog.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QString>
#include <QtCore/QTimer>
#include <QtWidgets/QWidget>

#include <vector>

namespace ps {

class Session;
class Viewport;

/// The line at the bottom: state, particles, milliseconds per frame with the slowest stage, real-time factor, density
/// error, energy drift; what a tool feels that a hand leads; notes and files on the right. One painted widget, so that
/// running numbers never push each other.
class StatusLine : public QWidget {
  Q_OBJECT
 public:
  struct State {
    bool ready = false, playing = false, failed = false;
    double realTime = 0, drawMilliseconds = 0;
    double silent = 0;  ///< s since the engine last said anything while it plays: a plugin may never come back
    int making = -1;    ///< per cent of the scene that is being made; -1: none is
    int working = -1;   ///< per cent of long work; -1: there is none
    QString work;       ///< "drawing"
    double left = -1;   ///< s, of that scene, else of that work; -1: it is too early to tell
    QString late;       ///< a plugin that does not come back
    QString headset;    ///< "In VR"
    QString graphics;   ///< "OpenGL 4.5"
    QString note;       ///< "1 note: ice stiffness is limited by the step"
    bool mild = false;  ///< the note is no warning
    QString file;       ///< "Autosaved 14:32"
    SnapshotPtr snapshot;
  };
  /// `view`: nullptr where there is no picture.
  StatusLine(Session& session, Viewport* view, QWidget* parent = nullptr);
  void setState(const State& state);  ///< until something happens in the session
  const State& state() const { return m_state; }
  void setHeadset(const QString& state);  ///< "": nobody is in one
  /// Of work beside that of the session, "Mending"; -1 per cent: there is none.
  void setWork(const QString& stage, int percent);
  /// In the place of notes, for half a minute; "" ends that.
  void say(const QString& sentence, MessageLevel level = MessageLevel::Info);
  /// Energy drift as a share of what was exchanged since the start.
  double drift() const;
  QStringList parts() const;                      ///< as shown, left to right
  QRectF noteRect() const { return m_noteRect; }  ///< as it was painted last; empty: there is none
  QString tipAt(const QPointF& at) const;         ///< what the part there means; "" beside them

 Q_SIGNALS:
  void noteClicked(const QString& parameter);  ///< its address; "" where the note has none

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;

 private:
  struct Part {
    QString strong, weak;
    QString strongRoom{}, weakRoom{};  ///< the widest that usually stands there: the place is as wide from the start
    QString tip{};
  };
  struct Place {
    QRectF rect;
    QString tip;
  };
  void follow();
  void followWork();
  void followHome();
  void refresh();
  void addNote(State& state);
  void tellOfSketches(const StrokeChanged& event);
  void noteRecorded(const ChangeEvent& event);
  void tellOfRecorded();
  std::vector<Part> leftParts() const;
  void followTool();
  Part toolPart() const;
  QString detail(size_t stage) const;
  void paintParts(QPainter& painter, double right);
  Session& m_session;
  Viewport* m_view;
  QString m_fileText, m_noteAddress, m_late, m_headset, m_said;
  QString m_saidOfRecorded;      ///< of the moment that is shown
  bool m_recordedStays = false;  ///< something was changed that acts after what is shown
  int64_t m_step = 0;            ///< of the history, that was told of last
  QString m_stage;
  int m_percent = -1;                         ///< of setWork()
  double m_makingLeft = -1, m_workLeft = -1;  ///< s, of the session's; -1: too early to tell
  MessageLevel m_saidLevel = MessageLevel::Info;
  QTimer m_saying;
  State m_state;
  uint64_t m_revision = 0;
  bool m_started = false;
  double m_startEnergy = 0, m_milliseconds = 0;
  ToolContact m_tool;  ///< that a hand has led last, smoothed; without a body: none
  std::array<double, static_cast<size_t>(Stage::Count)> m_stages{};
  QRectF m_noteRect;
  std::vector<Place> m_places;       ///< of what is painted
  QString m_shownAddress;            ///< of the note as it is painted
  std::optional<QString> m_pressed;  ///< the address of the note that the button went down on
  QTimer m_watch;
  QElapsedTimer m_sinceValues;
  struct Width {
    double strong = 0, whole = 0;
  };
  std::vector<Width> m_widths;  ///< of the parts on the left, the widest in this run
  size_t m_slowest = 0;         ///< stage that is named
};

}  // namespace ps
