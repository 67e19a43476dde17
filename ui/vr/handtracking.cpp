// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/handtracking.h"

#include "ui/vr/hands.h"

namespace ps::vr {
namespace {

static_assert(kJoints == XR_HAND_JOINT_COUNT_EXT && kWristJoint == XR_HAND_JOINT_WRIST_EXT &&
              kThumbTip == XR_HAND_JOINT_THUMB_TIP_EXT && kIndexTip == XR_HAND_JOINT_INDEX_TIP_EXT &&
              kMiddleKnuckle == XR_HAND_JOINT_MIDDLE_PROXIMAL_EXT && kLittleTip == XR_HAND_JOINT_LITTLE_TIP_EXT);

bool seesHands(const Runtime& runtime) {
  auto hands = structure<XrSystemHandTrackingPropertiesEXT>(XR_TYPE_SYSTEM_HAND_TRACKING_PROPERTIES_EXT);
  auto properties = structure<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
  properties.next = &hands;
  return XR_SUCCEEDED(xrGetSystemProperties(runtime.instance(), runtime.system(), &properties)) &&
         hands.supportsHandTracking;
}

}  // namespace

HandTracking::HandTracking(const Runtime& runtime, const Session& session) : m_session(session) {
  if (runtime.has(kExtension) && seesHands(runtime)) create(runtime);
}

/// Where more is amiss than hands, the next call says so.
void HandTracking::create(const Runtime& runtime) {
  m_destroy = runtime.function<PFN_xrDestroyHandTrackerEXT>("xrDestroyHandTrackerEXT");
  m_locate = runtime.function<PFN_xrLocateHandJointsEXT>("xrLocateHandJointsEXT");
  const auto make = runtime.function<PFN_xrCreateHandTrackerEXT>("xrCreateHandTrackerEXT");
  auto info = structure<XrHandTrackerCreateInfoEXT>(XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT);
  info.handJointSet = XR_HAND_JOINT_SET_DEFAULT_EXT;
  for (const size_t hand : {kLeft, kRight}) {
    info.hand = hand == kLeft ? XR_HAND_LEFT_EXT : XR_HAND_RIGHT_EXT;
    if (XR_FAILED(make(m_session.handle(), &info, &m_trackers[hand]))) m_trackers[hand] = XR_NULL_HANDLE;
  }
}

HandTracking::~HandTracking() {
  for (XrHandTrackerEXT tracker : m_trackers)
    if (tracker != XR_NULL_HANDLE) m_destroy(tracker);
}

std::optional<SeenHand> HandTracking::locate(size_t hand, XrTime time) const {
  if (m_trackers.at(hand) == XR_NULL_HANDLE) return {};
  auto info = structure<XrHandJointsLocateInfoEXT>(XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT);
  info.baseSpace = m_session.floor();
  info.time = time;
  std::array<XrHandJointLocationEXT, kJoints> located{};
  auto all = structure<XrHandJointLocationsEXT>(XR_TYPE_HAND_JOINT_LOCATIONS_EXT);
  all.jointCount = kJoints;
  all.jointLocations = located.data();
  if (XR_FAILED(m_locate(m_trackers[hand], &info, &all)) || !all.isActive) return {};
  constexpr XrSpaceLocationFlags kValid =
      XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
  SeenHand seen;
  for (size_t i = 0; i < kJoints; ++i) {
    if ((located[i].locationFlags & kValid) != kValid) return {};
    seen.joints[i] = {poseOf(located[i].pose).position, double(located[i].radius)};
  }
  seen.palm = poseOf(located[XR_HAND_JOINT_PALM_EXT].pose);
  return seen;
}

}  // namespace ps::vr
