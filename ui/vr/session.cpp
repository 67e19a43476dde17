// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/session.h"

#include "ui/vr/floor.h"
#include "ui/vr/graphics.h"

#include <algorithm>
#include <string>

namespace ps::vr {
namespace {

const char* const kLost = "The headset is about to be lost; see that it is connected, and enter VR again.";
const char* const kStopping = "The headset's software is about to stop; when it runs again, enter VR again.";

/// Throws Error where the headset asks for a newer OpenGL than there is.
void requireVersion(const XrGraphicsRequirementsOpenGLKHR& requirements) {
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  const XrVersion asked = requirements.minApiVersionSupported;
  if (XR_MAKE_VERSION(major, minor, 0) >= asked) return;
  throw Error("The headset asks for OpenGL " + std::to_string(XR_VERSION_MAJOR(asked)) + "." +
              std::to_string(XR_VERSION_MINOR(asked)) + ", and the window draws with " + std::to_string(major) + "." +
              std::to_string(minor) + "; a newer graphics driver may bring it.");
}

}  // namespace

Session::Session(Runtime& runtime) : m_runtime(runtime) {
  create();
  try {
    const Floor floor(runtime, m_session);
    m_floor = floor.space();
    m_floorType = floor.type();
  } catch (...) {
    xrDestroySession(m_session);
    throw;
  }
}

Session::~Session() { xrDestroySession(m_session); }

void Session::create() {
  const auto requirementsOf =
      m_runtime.function<PFN_xrGetOpenGLGraphicsRequirementsKHR>("xrGetOpenGLGraphicsRequirementsKHR");
  auto requirements = structure<XrGraphicsRequirementsOpenGLKHR>(XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR);
  check(requirementsOf(m_runtime.instance(), m_runtime.system(), &requirements), "xrGetOpenGLGraphicsRequirementsKHR");
  requireVersion(requirements);
  const auto blends = listed<XrEnvironmentBlendMode>("xrEnumerateEnvironmentBlendModes", [&](auto... room) {
    return xrEnumerateEnvironmentBlendModes(m_runtime.instance(), m_runtime.system(),
                                            XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, room...);
  });
  const bool hides = std::find(blends.begin(), blends.end(), XR_ENVIRONMENT_BLEND_MODE_OPAQUE) != blends.end();
  if (!hides && !blends.empty()) m_blend = blends.front();
  const GraphicsBinding binding = currentGraphics(m_runtime);
  auto info = structure<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
  info.next = std::visit([](const auto& own) -> const void* { return &own; }, binding);
  info.systemId = m_runtime.system();
  check(xrCreateSession(m_runtime.instance(), &info, &m_session), "xrCreateSession");
}

void Session::handleEvents(const std::function<void(const XrEventDataBuffer&)>& others) {
  while (const auto event = m_runtime.nextEvent()) {
    if (event->type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
      const auto& change = reinterpret_cast<const XrEventDataSessionStateChanged&>(*event);
      if (change.session == m_session) enter(change.state);
    } else if (event->type == XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING) {
      noteChange(reinterpret_cast<const XrEventDataReferenceSpaceChangePending&>(*event));
    } else if (event->type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) {
      m_ending = {true, kStopping};
    } else if (others) {
      others(*event);
    }
    if (m_ending) return;
  }
}

// STOPPING asks for a pause: the headset was taken off, and comes back as READY. Only EXITING is the end.
void Session::enter(XrSessionState state) {
  m_state = state;
  if (state == XR_SESSION_STATE_READY) {
    auto info = structure<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
    info.primaryViewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
    check(xrBeginSession(m_session, &info), "xrBeginSession");
    m_running = true;
  } else if (state == XR_SESSION_STATE_STOPPING) {
    m_running = false;
    check(xrEndSession(m_session), "xrEndSession");
  } else if (state == XR_SESSION_STATE_EXITING) {
    m_ending = Ending{};
  } else if (state == XR_SESSION_STATE_LOSS_PENDING) {
    m_ending = {true, kLost};
  }
}

// LOCAL changes at its wearer's wish alone, also where the floor is that of a stage, which stays. A stage that is
// measured anew concerns a floor in it.
void Session::noteChange(const XrEventDataReferenceSpaceChangePending& change) {
  const XrReferenceSpaceType type = change.referenceSpaceType;
  const bool concerns = type == XR_REFERENCE_SPACE_TYPE_LOCAL || type == m_floorType;
  if (concerns && change.session == m_session) m_recentred = change.changeTime;
}

bool Session::recentred(XrTime time) {
  const bool now = m_recentred && time >= *m_recentred;
  if (now) m_recentred.reset();
  return now;
}

void Session::requestExit() { check(xrRequestExitSession(m_session), "xrRequestExitSession"); }

XrFrameState Session::waitFrame() {
  auto frame = structure<XrFrameState>(XR_TYPE_FRAME_STATE);
  check(xrWaitFrame(m_session, nullptr, &frame), "xrWaitFrame");
  return frame;
}

void Session::beginFrame() { check(xrBeginFrame(m_session, nullptr), "xrBeginFrame"); }

void Session::endFrame(XrTime time, std::span<const XrCompositionLayerBaseHeader* const> layers) {
  auto info = structure<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
  info.displayTime = time;
  info.environmentBlendMode = m_blend;
  info.layerCount = static_cast<uint32_t>(layers.size());
  info.layers = layers.empty() ? nullptr : layers.data();
  check(xrEndFrame(m_session, &info), "xrEndFrame");
}

std::optional<std::array<XrView, 2>> Session::locateEyes(XrTime time) const {
  auto info = structure<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
  info.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
  info.displayTime = time;
  info.space = m_floor;
  auto state = structure<XrViewState>(XR_TYPE_VIEW_STATE);
  std::array<XrView, 2> views;
  views.fill(structure<XrView>(XR_TYPE_VIEW));
  uint32_t count = 0;
  check(xrLocateViews(m_session, &info, &state, 2, &count, views.data()), "xrLocateViews");
  constexpr XrViewStateFlags kValid = XR_VIEW_STATE_POSITION_VALID_BIT | XR_VIEW_STATE_ORIENTATION_VALID_BIT;
  if ((state.viewStateFlags & kValid) != kValid) return {};
  return views;
}

}  // namespace ps::vr
