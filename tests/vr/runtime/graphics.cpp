// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/graphics.h"

#include "tests/vr/runtime/refusal.h"

namespace ps::scripted {
namespace {

// Xlib ends the program at the error that a context of another thread gives, unless told otherwise.
bool makeCurrent(Display* display, GLXDrawable draw, GLXDrawable read, GLXContext context) {
  XSync(display, False);
  const XErrorHandler before = XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
  const bool done = glXMakeContextCurrent(display, draw, read, context);
  XSync(display, False);
  XSetErrorHandler(before);
  return done;
}

}  // namespace

GraphicsBinding readBinding(const XrSessionCreateInfo& info, bool eglEnabled) {
  const auto* xlib = chained<XrGraphicsBindingOpenGLXlibKHR>(info.next, XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR);
  const auto* egl = chained<XrGraphicsBindingEGLMNDX>(info.next, XR_TYPE_GRAPHICS_BINDING_EGL_MNDX);
  require(xlib || egl, XR_ERROR_GRAPHICS_DEVICE_INVALID, "the session has no OpenGL binding");
  require(!xlib || !egl, XR_ERROR_GRAPHICS_DEVICE_INVALID, "the session has two bindings");
  GraphicsBinding binding;
  if (xlib) {
    require(xlib->xDisplay && xlib->glxDrawable && xlib->glxContext && xlib->glxFBConfig && xlib->visualid,
            XR_ERROR_GRAPHICS_DEVICE_INVALID, "the Xlib binding is not whole");
    binding.xDisplay = xlib->xDisplay;
    binding.drawable = xlib->glxDrawable;
    binding.glxContext = xlib->glxContext;
    return binding;
  }
  require(eglEnabled, XR_ERROR_GRAPHICS_DEVICE_INVALID, "XR_MNDX_egl_enable was not enabled");
  require(egl->getProcAddress && egl->display != EGL_NO_DISPLAY && egl->context != EGL_NO_CONTEXT,
          XR_ERROR_GRAPHICS_DEVICE_INVALID, "the EGL binding is not whole");
  binding.eglDisplay = egl->display;
  binding.eglContext = egl->context;
  return binding;
}

void leaveNoContext() {
  if (Display* display = glXGetCurrentDisplay()) makeCurrent(display, 0, 0, nullptr);
  if (EGLDisplay display = eglGetCurrentDisplay(); display != EGL_NO_DISPLAY)
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

CurrentContext::CurrentContext(const GraphicsBinding& binding) : m_binding(binding) {
  const std::string why = "the session's OpenGL context is current on another thread";
  if (binding.glxContext) {
    m_glxContext = glXGetCurrentContext();
    if (m_glxContext == binding.glxContext) return;
    m_xDisplay = glXGetCurrentDisplay();
    m_draw = glXGetCurrentDrawable();
    m_read = glXGetCurrentReadDrawable();
    m_changed = makeCurrent(binding.xDisplay, binding.drawable, binding.drawable, binding.glxContext);
    require(m_changed, XR_ERROR_RUNTIME_FAILURE, why);
    return;
  }
  m_eglContext = eglGetCurrentContext();
  if (m_eglContext == binding.eglContext) return;
  m_eglDisplay = eglGetCurrentDisplay();
  m_eglDraw = eglGetCurrentSurface(EGL_DRAW);
  m_eglRead = eglGetCurrentSurface(EGL_READ);
  m_changed = eglMakeCurrent(binding.eglDisplay, EGL_NO_SURFACE, EGL_NO_SURFACE, binding.eglContext);
  require(m_changed, XR_ERROR_RUNTIME_FAILURE, why);
}

CurrentContext::~CurrentContext() {
  if (!m_changed) return;
  if (m_binding.glxContext) {
    makeCurrent(m_xDisplay ? m_xDisplay : m_binding.xDisplay, m_draw, m_read, m_glxContext);
  } else {
    eglMakeCurrent(m_eglDisplay != EGL_NO_DISPLAY ? m_eglDisplay : m_binding.eglDisplay, m_eglDraw, m_eglRead,
                   m_eglContext);
  }
}

}  // namespace ps::scripted
