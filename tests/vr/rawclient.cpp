// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/rawclient.h"

#include <cstdio>

namespace ps {

using vr::check;
using vr::structure;

RawClient::RawClient(HeadlessContext& context, const std::vector<std::string>& wishes)
    : m_context(context),
      m_current(context),
      m_runtime([&] {
        std::vector<std::string> all = wishes;
        all.emplace_back(XR_MNDX_EGL_ENABLE_EXTENSION_NAME);
        return all;
      }()),
      m_session(m_runtime) {}

RawClient::~RawClient() = default;

void RawClient::frames(int count) {
  for (int i = 0; i < count; ++i) {
    m_session.handleEvents();
    end(begin(), nullptr);
  }
  m_session.handleEvents();
}

XrTime RawClient::begin() {
  const XrFrameState state = m_session.waitFrame();
  m_session.beginFrame();
  return state.predictedDisplayTime;
}

XrSwapchain RawClient::swapchain(int64_t format, uint32_t side) {
  auto info = structure<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
  info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
  info.format = format;
  info.sampleCount = info.faceCount = info.arraySize = info.mipCount = 1;
  info.width = info.height = side;
  XrSwapchain made = XR_NULL_HANDLE;
  check(xrCreateSwapchain(handle(), &info, &made), "xrCreateSwapchain");
  return made;
}

void RawClient::show(XrSwapchain swapchain) {
  uint32_t index = 0;
  check(xrAcquireSwapchainImage(swapchain, nullptr, &index), "xrAcquireSwapchainImage");
  auto wait = structure<XrSwapchainImageWaitInfo>(XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO);
  check(xrWaitSwapchainImage(swapchain, &wait), "xrWaitSwapchainImage");
  check(xrReleaseSwapchainImage(swapchain, nullptr), "xrReleaseSwapchainImage");
}

XrResult RawClient::end(XrTime time, const XrCompositionLayerBaseHeader* layer) {
  auto info = structure<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
  info.displayTime = time;
  info.environmentBlendMode = XR_ENVIRONMENT_BLEND_MODE_OPAQUE;
  info.layerCount = layer ? 1 : 0;
  info.layers = layer ? &layer : nullptr;
  return xrEndFrame(handle(), &info);
}

RawClient::Projection RawClient::projection(XrSwapchain swapchain, int side) {
  Projection projection;
  projection.layer = structure<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
  projection.layer.space = m_session.floor();
  projection.layer.viewCount = 2;
  for (XrCompositionLayerProjectionView& view : projection.views) {
    view = structure<XrCompositionLayerProjectionView>(XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW);
    view.pose.orientation.w = 1;
    view.fov = {-0.7f, 0.7f, 0.7f, -0.7f};
    view.subImage = {swapchain, {{0, 0}, {side, side}}, 0};
  }
  return projection;
}

XrActionSet RawClient::actionSet(const char* name, uint32_t priority) {
  auto info = structure<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
  std::snprintf(info.actionSetName, sizeof info.actionSetName, "%s", name);
  std::snprintf(info.localizedActionSetName, sizeof info.localizedActionSetName, "Set %s", name);
  info.priority = priority;
  XrActionSet made = XR_NULL_HANDLE;
  check(xrCreateActionSet(m_runtime.instance(), &info, &made), "xrCreateActionSet");
  return made;
}

XrAction RawClient::action(XrActionSet set, const char* name, XrActionType type, bool bothHands) {
  const XrPath hands[] = {m_runtime.path("/user/hand/left"), m_runtime.path("/user/hand/right")};
  auto info = structure<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
  std::snprintf(info.actionName, sizeof info.actionName, "%s", name);
  std::snprintf(info.localizedActionName, sizeof info.localizedActionName, "Action %s", name);
  info.actionType = type;
  info.countSubactionPaths = bothHands ? 2 : 0;
  info.subactionPaths = bothHands ? hands : nullptr;
  XrAction made = XR_NULL_HANDLE;
  check(xrCreateAction(set, &info, &made), "xrCreateAction");
  return made;
}

XrResult RawClient::suggest(const char* profile, XrAction action, const char* path) {
  const XrActionSuggestedBinding binding{action, m_runtime.path(path)};
  auto info = structure<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
  info.interactionProfile = m_runtime.path(std::string("/interaction_profiles/") + profile);
  info.countSuggestedBindings = 1;
  info.suggestedBindings = &binding;
  return xrSuggestInteractionProfileBindings(m_runtime.instance(), &info);
}

XrResult RawClient::attach(std::vector<XrActionSet> sets) {
  auto info = structure<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
  info.countActionSets = static_cast<uint32_t>(sets.size());
  info.actionSets = sets.data();
  return xrAttachSessionActionSets(handle(), &info);
}

XrResult RawClient::sync(const std::vector<XrActionSet>& sets) {
  std::vector<XrActiveActionSet> active;
  active.reserve(sets.size());
  for (const XrActionSet set : sets) active.push_back({set, XR_NULL_PATH});
  auto info = structure<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
  info.countActiveActionSets = static_cast<uint32_t>(active.size());
  info.activeActionSets = active.data();
  return xrSyncActions(handle(), &info);
}

XrActionStateGetInfo RawClient::stateInfo(XrAction action, const std::string& hand) {
  auto info = structure<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
  info.action = action;
  info.subactionPath = hand.empty() ? XR_NULL_PATH : m_runtime.path(hand);
  return info;
}

}  // namespace ps
