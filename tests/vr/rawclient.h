// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"
#include "ui/vr/session.h"

#include <string>
#include <vector>

namespace ps {

/// A client that calls OpenXR by itself, to call it wrongly too. Its context is current as long as it lives.
class RawClient {
 public:
  explicit RawClient(HeadlessContext& context, const std::vector<std::string>& wishes = {});
  ~RawClient();
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  vr::Runtime& runtime() { return m_runtime; }
  vr::Session& session() { return m_session; }
  XrSession handle() { return m_session.handle(); }
  /// Frames without layers, until so many have passed; the session has the focus after three.
  void frames(int count);
  /// Waits for a frame and begins it; the time of its display.
  XrTime begin();

  XrSwapchain swapchain(int64_t format = 0x8C43 /* GL_SRGB8_ALPHA8 */, uint32_t side = 16);
  void show(XrSwapchain swapchain);  ///< acquires, waits for and releases an image
  XrResult end(XrTime time, const XrCompositionLayerBaseHeader* layer);
  /// A layer of the same picture for both eyes.
  struct Projection {
    XrCompositionLayerProjection layer;
    std::array<XrCompositionLayerProjectionView, 2> views;
    const XrCompositionLayerBaseHeader* header() {
      layer.views = views.data();
      return reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
    }
  };
  Projection projection(XrSwapchain swapchain, int side = 16);

  XrActionSet actionSet(const char* name = "set", uint32_t priority = 0);
  XrAction action(XrActionSet set, const char* name, XrActionType type, bool bothHands = true);
  XrResult suggest(const char* profile, XrAction action, const char* path);
  XrResult attach(std::vector<XrActionSet> sets);
  XrResult sync(const std::vector<XrActionSet>& sets);
  /// Of one hand ("/user/hand/left"), or of all ("").
  XrActionStateGetInfo stateInfo(XrAction action, const std::string& hand = {});

 private:
  HeadlessContext& m_context;
  struct Current {
    explicit Current(HeadlessContext& context) { context.makeCurrent(); }
  } m_current;
  vr::Runtime m_runtime;
  vr::Session m_session;
};

}  // namespace ps
