// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/graphics.h"

namespace ps::vr {
namespace {

EGLConfig eglConfigOf(EGLDisplay display, EGLContext context) {
  EGLint number = 0;
  if (!eglQueryContext(display, context, EGL_CONFIG_ID, &number) || number == 0) return nullptr;  // made without one
  const EGLint wanted[] = {EGL_CONFIG_ID, number, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  return eglChooseConfig(display, wanted, &config, 1, &count) && count > 0 ? config : nullptr;
}

XrGraphicsBindingEGLMNDX eglBinding(EGLContext context) {
  auto binding = structure<XrGraphicsBindingEGLMNDX>(XR_TYPE_GRAPHICS_BINDING_EGL_MNDX);
  binding.getProcAddress = eglGetProcAddress;  // epoxy has a pointer of this name
  binding.display = eglGetCurrentDisplay();
  binding.config = eglConfigOf(binding.display, context);
  binding.context = context;
  return binding;
}

XrGraphicsBindingOpenGLXlibKHR xlibBinding(GLXContext context) {
  auto binding = structure<XrGraphicsBindingOpenGLXlibKHR>(XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR);
  binding.xDisplay = glXGetCurrentDisplay();
  binding.glxDrawable = glXGetCurrentDrawable();
  binding.glxContext = context;
  int number = 0, screen = 0, count = 0;
  glXQueryContext(binding.xDisplay, context, GLX_FBCONFIG_ID, &number);
  glXQueryContext(binding.xDisplay, context, GLX_SCREEN, &screen);
  const int wanted[] = {GLX_FBCONFIG_ID, number, 0};
  GLXFBConfig* configs = glXChooseFBConfig(binding.xDisplay, screen, wanted, &count);
  if (!configs || count == 0) throw Error("The window's OpenGL cannot be told to the headset's software.");
  binding.glxFBConfig = configs[0];
  XFree(configs);
  int visual = 0;
  glXGetFBConfigAttrib(binding.xDisplay, binding.glxFBConfig, GLX_VISUAL_ID, &visual);
  binding.visualid = static_cast<uint32_t>(visual);
  return binding;
}

}  // namespace

GraphicsBinding currentGraphics(const Runtime& runtime) {
  if (EGLContext context = eglGetCurrentContext(); context != EGL_NO_CONTEXT) {
    if (!runtime.has(XR_MNDX_EGL_ENABLE_EXTENSION_NAME))
      throw Error("The headset's software takes no pictures of EGL; start the editor under X11 with GLX.");
    return eglBinding(context);
  }
  if (GLXContext context = glXGetCurrentContext()) return xlibBinding(context);
  throw Error("There is no OpenGL to draw for the headset with.");
}

const void* currentContext() {
  const EGLContext context = eglGetCurrentContext();
  return context != EGL_NO_CONTEXT ? static_cast<const void*>(context) : glXGetCurrentContext();
}

}  // namespace ps::vr
