// SPDX-License-Identifier: Apache-2.0
#include "ui/window/headsetcontext.h"

#include "core/base/error.h"

#include <QtCore/QThread>

#include <utility>

namespace ps {

HeadsetContext::HeadsetContext(QOpenGLContext* window) : m_home(QThread::currentThread()) {
  QSurfaceFormat format = window ? window->format() : QSurfaceFormat::defaultFormat();
  format.setSwapInterval(0);  // the headset's runtime paces
  m_context.setShareContext(window);
  m_context.setFormat(format);
  const bool made = m_context.create();
  const QSurfaceFormat given = m_context.format();
  if (!made || std::pair(given.majorVersion(), given.minorVersion()) < std::pair(4, 3))
    throw Error("VR needs OpenGL 4.3, which this graphics driver does not offer; a newer driver brings it.");
  m_surface.setFormat(given);
  m_surface.create();
  m_context.moveToThread(nullptr);  // whoever makes it current next may take it
}

HeadsetContext::~HeadsetContext() { m_context.moveToThread(m_home); }

void HeadsetContext::makeCurrent() {
  m_context.moveToThread(QThread::currentThread());
  if (m_context.makeCurrent(&m_surface)) return;
  m_context.moveToThread(nullptr);  // nobody releases what was not had
  throw Error("The window's OpenGL cannot be used for the headset; start the program again.");
}

void HeadsetContext::release() {
  m_context.doneCurrent();
  m_context.moveToThread(nullptr);
}

}  // namespace ps
