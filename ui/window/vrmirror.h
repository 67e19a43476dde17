// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QTimer>
#include <QtOpenGLWidgets/QOpenGLWidget>

#include <memory>

namespace ps {

namespace vr {
class Mirror;
}
class Viewport;

/// What the left eye sees in the headset, in place of the view, which is not drawn meanwhile.
class VrMirror : public QOpenGLWidget {
  Q_OBJECT
 public:
  /// Over the view, which must outlive it, wherever that goes.
  VrMirror(std::shared_ptr<vr::Mirror> mirror, Viewport& view);
  ~VrMirror() override;
  uint64_t pictures() const;  ///< that were there to be shown so far

 protected:
  void paintGL() override;
  void resizeGL(int width, int height) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void follow();

  std::shared_ptr<vr::Mirror> m_mirror;
  Viewport& m_view;
  QTimer m_next{this};
  bool m_again = true;  ///< what was there is lost
};

}  // namespace ps
