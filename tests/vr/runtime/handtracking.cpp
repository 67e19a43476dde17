// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/joints.h"
#include "tests/vr/runtime/placing.h"
#include "tests/vr/runtime/timeline.h"

// The joints of hands (XR_EXT_hand_tracking).
namespace ps::scripted {

XrResult createHandTracker(Instance& instance, XrSession handle, const XrHandTrackerCreateInfoEXT* info,
                           XrHandTrackerEXT* made) {
  Session& session = sessionOf(instance, handle);
  typed(info, XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT);
  require(info->hand == XR_HAND_LEFT_EXT || info->hand == XR_HAND_RIGHT_EXT, XR_ERROR_VALIDATION_FAILURE,
          "a tracker is of the left or of the right hand");
  require(info->handJointSet == XR_HAND_JOINT_SET_DEFAULT_EXT, XR_ERROR_VALIDATION_FAILURE,
          "there is the default set of joints only");
  wanted(made) = session.handTrackers.add({info->hand == XR_HAND_LEFT_EXT ? size_t{0} : size_t{1}});
  return XR_SUCCESS;
}

XrResult destroyHandTracker(Instance& instance, XrHandTrackerEXT handle) {
  openSession(instance).handTrackers.at(handle);
  instance.session->handTrackers.erase(handle);
  return XR_SUCCESS;
}

XrResult locateHandJoints(Instance& instance, XrHandTrackerEXT handle, const XrHandJointsLocateInfoEXT* info,
                          XrHandJointLocationsEXT* locations) {
  Session& session = openSession(instance);
  const size_t hand = session.handTrackers.at(handle).hand;
  const Space& base = session.spaces.at(typed(info, XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT).baseSpace);
  require(info->time > 0, XR_ERROR_TIME_INVALID, "a time must be positive");
  require(typed(locations, XR_TYPE_HAND_JOINT_LOCATIONS_EXT).jointCount == XR_HAND_JOINT_COUNT_EXT,
          XR_ERROR_VALIDATION_FAILURE, "a hand of the default set has XR_HAND_JOINT_COUNT_EXT joints");
  wanted(locations->jointLocations);
  const double frame = frameOf(instance, info->time);
  const HandState state = instance.script.hand(hand, frame);
  const auto origin = originAt(instance, base, frame);
  locations->isActive = !state.shape.empty() && state.active && origin ? XR_TRUE : XR_FALSE;
  const HandJoints joints = jointsOf(state.shape, hand);
  for (size_t i = 0; i < joints.size(); ++i) {
    XrHandJointLocationEXT& location = locations->jointLocations[i];
    location = {};
    if (!locations->isActive) continue;
    location.locationFlags = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
    if (state.tracked)
      location.locationFlags |= XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;
    location.pose = combined(inverse(*origin), combined(instance.script.aim(hand, frame), joints[i].pose));
    location.radius = joints[i].radius;
  }
  return XR_SUCCESS;
}

}  // namespace ps::scripted
