// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/error.h"

#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QThread>

#include <memory>

namespace ps {

/// An OpenGL context of the X server that shares with a window's, as the editor makes one for the headset's thread.
class WindowContext {
 public:
  /// On the thread of the windows. Throws Error.
  WindowContext() : m_home(QThread::currentThread()) {
    QSurfaceFormat format;
    format.setVersion(4, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    m_window.setFormat(format);
    m_own.setShareContext(&m_window);
    m_own.setFormat(format);
    if (!m_window.create() || !m_own.create()) throw Error("The X server has no OpenGL 4.3.");
    m_surface.setFormat(format);
    m_surface.create();
    m_own.moveToThread(nullptr);  // whoever makes it current next may take it
  }
  void makeCurrent() {
    m_own.moveToThread(QThread::currentThread());
    if (!m_own.makeCurrent(&m_surface)) throw Error("The window's OpenGL cannot be used on another thread.");
  }
  void release() {
    m_own.doneCurrent();
    m_own.moveToThread(nullptr);
  }
  ~WindowContext() { m_own.moveToThread(m_home); }
  WindowContext(const WindowContext&) = delete;
  WindowContext& operator=(const WindowContext&) = delete;

 private:
  QThread* m_home;
  QOpenGLContext m_window, m_own;
  QOffscreenSurface m_surface;
};

}  // namespace ps
