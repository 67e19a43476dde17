// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtGui/QOffscreenSurface>
#include <QtGui/QOpenGLContext>

class QThread;

namespace ps {

/// An OpenGL context for the headset's thread, of the window's kind, which shares its objects.
class HeadsetContext {
 public:
  /// On the thread of the windows. `window`: the context of a view; nullptr: there is none. Throws Error where there is
  /// no OpenGL 4.3.
  explicit HeadsetContext(QOpenGLContext* window);
  ~HeadsetContext();  ///< there too, after release()
  HeadsetContext(const HeadsetContext&) = delete;
  HeadsetContext& operator=(const HeadsetContext&) = delete;

  void makeCurrent();  ///< on any one thread. Throws Error
  void release();      ///< there

 private:
  QThread* m_home;
  QOpenGLContext m_context;
  QOffscreenSurface m_surface;
};

}  // namespace ps
