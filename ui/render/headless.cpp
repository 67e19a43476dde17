// SPDX-License-Identifier: Apache-2.0
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include "core/base/error.h"
#include "ui/render/camera.h"
#include "ui/render/glstate.h"
#include "ui/render/renderer.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace ps {

struct HeadlessContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  ~Impl() {
    if (context == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
    // The display belongs to the process: others may hold contexts of it.
  }
};

namespace {

// Mesa's surfaceless platform, else the first device that starts, which is what vendors' own drivers offer.
EGLDisplay openDisplay() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto has = [&](const char* name) { return extensions && std::strstr(extensions, name); };
  if (!has("EGL_EXT_platform_base")) return EGL_NO_DISPLAY;
  if (has("EGL_MESA_platform_surfaceless")) {
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  }
  if (!has("EGL_EXT_platform_device") || !has("EGL_EXT_device_enumeration")) return EGL_NO_DISPLAY;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (!eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count)) return EGL_NO_DISPLAY;
  for (EGLint i = 0; i < count; ++i) {
    const EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<size_t>(i)], nullptr);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
  }
  return EGL_NO_DISPLAY;
}

}  // namespace

HeadlessContext::HeadlessContext(const HeadlessContext* shared) : m(std::make_unique<Impl>()) {
  m->display = shared ? shared->m->display : openDisplay();
  if (m->display == EGL_NO_DISPLAY)
    throw Error(
        "EGL cannot draw without a display here; install a driver that has OpenGL 4.3, such as Mesa's llvmpipe");
  eglBindAPI(EGL_OPENGL_API);
  const EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(m->display, wanted, &config, 1, &count);
  m->context = eglCreateContext(m->display, count ? config : EGL_NO_CONFIG_KHR,
                                shared ? shared->m->context : EGL_NO_CONTEXT, attributes);
  if (m->context == EGL_NO_CONTEXT) throw Error("EGL has no OpenGL 4.3 context; a newer graphics driver is needed");
  makeCurrent();
}

HeadlessContext::~HeadlessContext() = default;

void HeadlessContext::makeCurrent() {
  eglBindAPI(EGL_OPENGL_API);  // per thread
  if (!eglMakeCurrent(m->display, EGL_NO_SURFACE, EGL_NO_SURFACE, m->context))
    throw Error("the OpenGL context cannot be used on this thread; it may be current on another");
}

void HeadlessContext::release() { eglMakeCurrent(m->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

std::string HeadlessContext::description() const {
  const auto text = [](GLenum name) {
    const GLubyte* value = glGetString(name);
    return std::string(value ? reinterpret_cast<const char*>(value) : "?");
  };
  return text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

namespace {

/// A framebuffer over one picture, bound until it goes.
struct Picture {
  Picture(int width, int height) {
    GLint bound = 0;
    glGetIntegerv(GL_RENDERBUFFER_BINDING, &bound);
    glGenRenderbuffers(1, &picture);
    glBindRenderbuffer(GL_RENDERBUFFER, picture);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glBindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(bound));
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, picture);
  }
  ~Picture() {
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &picture);
  }
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  GLuint framebuffer = 0, picture = 0;
};

}  // namespace

std::vector<uint8_t> renderImage(Renderer& renderer, const Eye& eye, const PictureSize& size, int coarser) {
  renderer.checkSize(size);
  const render::GlState state;
  const Picture picture(size.width, size.height);
  renderer.draw(eye, {picture.framebuffer, 0, 0, size, 0, nullptr, coarser});

  const size_t row = static_cast<size_t>(size.width) * 4;
  std::vector<uint8_t> pixels(row * static_cast<size_t>(size.height));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  GLint alignment = 4, length = 0;
  glGetIntegerv(GL_PACK_ALIGNMENT, &alignment);
  glGetIntegerv(GL_PACK_ROW_LENGTH, &length);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glReadPixels(0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  glPixelStorei(GL_PACK_ALIGNMENT, alignment);
  glPixelStorei(GL_PACK_ROW_LENGTH, length);
  for (size_t top = 0, bottom = static_cast<size_t>(size.height) - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(pixels.begin() + static_cast<ptrdiff_t>(top * row),
                     pixels.begin() + static_cast<ptrdiff_t>((top + 1) * row),
                     pixels.begin() + static_cast<ptrdiff_t>(bottom * row));
  return pixels;
}

}  // namespace ps
