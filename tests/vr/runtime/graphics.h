// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/openxr.h"

namespace ps::scripted {

/// The client's OpenGL context, by Xlib or by EGL.
struct GraphicsBinding {
  Display* xDisplay = nullptr;
  GLXDrawable drawable = 0;
  GLXContext glxContext = nullptr;
  EGLDisplay eglDisplay = EGL_NO_DISPLAY;
  EGLContext eglContext = EGL_NO_CONTEXT;
};

/// Reads a session's binding; both extensions say what they need. Throws Refusal XR_ERROR_GRAPHICS_DEVICE_INVALID.
GraphicsBinding readBinding(const XrSessionCreateInfo& info, bool eglEnabled);

/// On this thread.
void leaveNoContext();

/// Makes the client's context current for as long as it lives, and what was current before again. The client may have
/// it current on this thread or on none. Throws Refusal XR_ERROR_RUNTIME_FAILURE where another thread has it.
class CurrentContext {
 public:
  explicit CurrentContext(const GraphicsBinding& binding);
  ~CurrentContext();
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

 private:
  GraphicsBinding m_binding;
  bool m_changed = false;
  Display* m_xDisplay = nullptr;
  GLXDrawable m_draw = 0, m_read = 0;
  GLXContext m_glxContext = nullptr;
  EGLDisplay m_eglDisplay = EGL_NO_DISPLAY;
  EGLSurface m_eglDraw = EGL_NO_SURFACE, m_eglRead = EGL_NO_SURFACE;
  EGLContext m_eglContext = EGL_NO_CONTEXT;
};

}  // namespace ps::scripted
