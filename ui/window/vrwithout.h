// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/headsetlink.h"
#include "ui/vr/simulatedroom.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QTimer>
#include <QtOpenGLWidgets/QOpenGLWidget>

#include <memory>
#include <set>

namespace ps {

namespace vr {
class LiveScene;
}

/// What one eye would see in a headset, in a window in which mouse and keys are head and hands: all of VR but the
/// headset, to try it, to learn it, and to find faults in it.
class VrWithout : public QOpenGLWidget {
  Q_OBJECT
 public:
  VrWithout(std::shared_ptr<vr::HeadsetLink> link, QWidget* parent);
  ~VrWithout() override;
  uint64_t frames() const { return m_frames; }
  vr::SimulatedRoom& room() { return m_room; }

 Q_SIGNALS:
  void closed();
  void failed(const QString& problem);

 protected:
  void initializeGL() override;
  void paintGL() override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void closeEvent(QCloseEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;
  bool focusNextPrevChild(bool) override { return false; }  ///< Tab takes the other hand

 private:
  double aspect() const;
  void useKeys(double passed);
  void paintHints();
  void releaseGl();
  void fail(const QString& problem);

  std::shared_ptr<vr::HeadsetLink> m_link;
  std::unique_ptr<vr::LiveScene> m_scene;
  vr::SimulatedRoom m_room;
  std::set<int> m_keys;  ///< that are down
  bool m_pulls = false;  ///< the left button is down
  QPointF m_at;          ///< of the mouse
  QTimer m_next;
  QElapsedTimer m_clock;
  double m_time = 0;  ///< s, of the last frame
  uint64_t m_frames = 0;
};

}  // namespace ps
