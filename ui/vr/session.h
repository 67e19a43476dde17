// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/vr/ending.h"
#include "ui/vr/runtime.h"

#include <array>
#include <functional>
#include <optional>
#include <span>

namespace ps::vr {

/// The headset as this program has it: its states, its frames, and where things are in it. It draws with the OpenGL
/// context that is current on the thread that makes it; every call comes from that thread, with the context current.
/// All calls throw Failure when the headset or its software is lost.
class Session {
 public:
  /// Throws Error where no context is current or the runtime refuses it.
  explicit Session(Runtime& runtime);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Follows what the runtime says: begins the session when the headset is put on, and ends it when it is taken off.
  /// `others` get the events that are not the session's.
  void handleEvents(const std::function<void(const XrEventDataBuffer&)>& others = {});
  bool running() const { return m_running; }  ///< there are frames to draw
  bool focused() const { return m_state == XR_SESSION_STATE_FOCUSED; }
  bool visible() const { return m_state == XR_SESSION_STATE_VISIBLE; }  ///< behind a menu of the headset
  const std::optional<Ending>& ending() const { return m_ending; }
  /// Whether the space of the floor is another one from a frame on, or its wearer has asked for that: said once.
  bool recentred(XrTime time);
  void requestExit();

  XrFrameState waitFrame();
  void beginFrame();
  void endFrame(XrTime time, std::span<const XrCompositionLayerBaseHeader* const> layers);
  /// Of both eyes, in the floor's space; nothing while the headset does not know where it is.
  std::optional<std::array<XrView, 2>> locateEyes(XrTime time) const;

  XrSession handle() const { return m_session; }
  /// y is up, and 0 at the floor, as well as the headset knows it; z points back from where its user looked at first.
  XrSpace floor() const { return m_floor; }

 private:
  void create();
  void enter(XrSessionState state);
  void noteChange(const XrEventDataReferenceSpaceChangePending& change);

  Runtime& m_runtime;
  XrSession m_session = XR_NULL_HANDLE;
  XrSpace m_floor = XR_NULL_HANDLE;
  XrReferenceSpaceType m_floorType = XR_REFERENCE_SPACE_TYPE_LOCAL;
  std::optional<XrTime> m_recentred;  ///< from when on the room is another
  XrSessionState m_state = XR_SESSION_STATE_UNKNOWN;
  bool m_running = false;
  XrEnvironmentBlendMode m_blend = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;  ///< or what a headset has that shows the room
  std::optional<Ending> m_ending;
};

}  // namespace ps::vr
