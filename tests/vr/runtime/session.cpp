// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/call.h"
#include "tests/vr/runtime/closing.h"
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/lifecycle.h"
#include "tests/vr/runtime/limits.h"

namespace ps::scripted {

void closeSession(Instance& instance) {
  Session& session = *instance.session;
  {
    const CurrentContext current(session.graphics);
    session.swapchains.each([&](XrSwapchain, Swapchain& swapchain) { deleteTextures(instance, swapchain); });
  }
  instance.session.reset();
  instance.sessionHandle = XR_NULL_HANDLE;
  instance.log.write({{"session", "destroyed"}, {"frame", instance.frame}});
}

XrResult createSession(Instance& instance, XrInstance, const XrSessionCreateInfo* info, XrSession* handle) {
  require(typed(info, XR_TYPE_SESSION_CREATE_INFO).systemId == 1, XR_ERROR_SYSTEM_INVALID, "there is no such system");
  wanted(handle);
  require(!instance.session, XR_ERROR_LIMIT_REACHED, "there is a session already");
  require(has(instance, XR_KHR_OPENGL_ENABLE_EXTENSION_NAME), XR_ERROR_GRAPHICS_DEVICE_INVALID,
          "XR_KHR_opengl_enable was not enabled");
  require(instance.graphicsAsked, XR_ERROR_GRAPHICS_REQUIREMENTS_CALL_MISSING,
          "xrGetOpenGLGraphicsRequirementsKHR() was not called");
  Session session;
  session.graphics = readBinding(*info, has(instance, XR_MNDX_EGL_ENABLE_EXTENSION_NAME));
  { const CurrentContext usable(session.graphics); }
  instance.session = std::move(session);
  instance.sessionHandle = *handle = reinterpret_cast<XrSession>(nextHandle());
  const bool xlib = instance.session->graphics.glxContext != nullptr;
  instance.log.write({{"session", "created"}, {"binding", xlib ? "xlib" : "egl"}, {"frame", instance.frame}});
  sessionCreated(instance);
  return XR_SUCCESS;
}

XrResult destroySession(Instance& instance, XrSession handle) {
  sessionOf(instance, handle);
  closeSession(instance);
  return XR_SUCCESS;
}

XrResult beginSession(Instance& instance, XrSession handle, const XrSessionBeginInfo* info) {
  Session& session = sessionOf(instance, handle);
  requireStereo(typed(info, XR_TYPE_SESSION_BEGIN_INFO).primaryViewConfigurationType);
  require(!session.running, XR_ERROR_SESSION_RUNNING, "the session runs already");
  require(session.state == XR_SESSION_STATE_READY, XR_ERROR_SESSION_NOT_READY, "the session is not READY");
  session.running = true;
  session.frameWaited = session.frameBegun = false;
  instance.log.write({{"session", "begun"}, {"frame", instance.frame}});
  return XR_SUCCESS;
}

XrResult endSession(Instance& instance, XrSession handle) {
  Session& session = sessionOf(instance, handle);
  require(session.running, XR_ERROR_SESSION_NOT_RUNNING, "the session does not run");
  require(session.state == XR_SESSION_STATE_STOPPING, XR_ERROR_SESSION_NOT_STOPPING, "the session is not STOPPING");
  session.running = false;
  instance.log.write({{"session", "ended"}, {"frame", instance.frame}});
  runtime().frameBegun.notify_all();
  sessionEnded(instance);
  return XR_SUCCESS;
}

XrResult requestExitSession(Instance& instance, XrSession handle) {
  require(sessionOf(instance, handle).running, XR_ERROR_SESSION_NOT_RUNNING, "the session does not run");
  exitRequested(instance);
  return XR_SUCCESS;
}

}  // namespace ps::scripted
