// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/limits.h"
#include "tests/vr/runtime/placing.h"
#include "tests/vr/runtime/sources.h"
#include "tests/vr/runtime/timeline.h"

#include <algorithm>

namespace ps::scripted {
namespace {

// XR_EXT_local_floor is younger than Debian 12's headers.
constexpr auto kLocalFloor = static_cast<XrReferenceSpaceType>(1000426000);

constexpr XrSpaceLocationFlags kValid = XR_SPACE_LOCATION_POSITION_VALID_BIT | XR_SPACE_LOCATION_ORIENTATION_VALID_BIT;
constexpr XrSpaceLocationFlags kTracked =
    XR_SPACE_LOCATION_POSITION_TRACKED_BIT | XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT;

/// In the stage.
struct Place {
  XrPosef pose = kNoMotion;
  XrSpaceLocationFlags flags = 0;
};

std::vector<XrReferenceSpaceType> offeredSpaces(const Instance& instance) {
  std::vector<XrReferenceSpaceType> types = {XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL};
  if (instance.script.stage) types.push_back(XR_REFERENCE_SPACE_TYPE_STAGE);
  if (has(instance, "XR_EXT_local_floor")) types.push_back(kLocalFloor);
  return types;
}

XrPosef originOf(const Instance& instance, XrReferenceSpaceType type, double frame) {
  if (type == XR_REFERENCE_SPACE_TYPE_VIEW) return instance.script.head(frame);
  if (type == XR_REFERENCE_SPACE_TYPE_STAGE) return kNoMotion;
  XrPosef origin = instance.localOrigin;
  if (type == kLocalFloor) origin.position.y = 0;
  return origin;
}

Place placeOf(Instance& instance, const Space& space, double frame) {
  if (space.reference) return {combined(originOf(instance, *space.reference, frame), space.offset), kValid | kTracked};
  Action& action = instance.actions.at(space.action);
  if (!action.states[space.subaction].active) return {};
  const int wanted = subactionHand(instance, action, space.subaction);
  const std::vector<Source> sources = sourcesOf(instance, space.action, wanted);
  if (sources.empty()) return {};
  const auto& [hand, component] = sources.front();
  const Script& script = instance.script;
  const bool aims = component.starts_with("/input/aim");
  const XrPosef pose = aims ? script.aim(hand, frame) : script.grip(hand, frame);
  return {combined(pose, space.offset), script.hand(hand, frame).tracked ? kValid | kTracked : kValid};
}

Place relative(Instance& instance, const Space& space, const Space& base, double frame) {
  const Place place = placeOf(instance, space, frame), origin = placeOf(instance, base, frame);
  if ((place.flags & kValid) == 0 || (origin.flags & kValid) == 0) return {};
  return {combined(inverse(origin.pose), place.pose), place.flags & origin.flags};
}

// By the difference over half a frame around the time.
void fillVelocity(Instance& instance, const Space& space, const Space& base, double frame, XrSpaceVelocity& velocity) {
  constexpr double kStep = 0.25;  // frames
  const Place before = relative(instance, space, base, frame - kStep);
  const Place after = relative(instance, space, base, frame + kStep);
  velocity.velocityFlags = 0;
  if (before.flags == 0 || after.flags == 0) return;
  velocity.velocityFlags = XR_SPACE_VELOCITY_LINEAR_VALID_BIT | XR_SPACE_VELOCITY_ANGULAR_VALID_BIT;
  const auto rate = static_cast<float>(1e9 / (2 * kStep * double(instance.clock.period)));
  const XrVector3f& a = before.pose.position;
  const XrVector3f& b = after.pose.position;
  velocity.linearVelocity = {(b.x - a.x) * rate, (b.y - a.y) * rate, (b.z - a.z) * rate};
  const XrPosef turn = combined(after.pose, {inverse(before.pose).orientation, {0, 0, 0}});
  const XrVector3f angle = rotationVector(turn.orientation);
  velocity.angularVelocity = {angle.x * rate, angle.y * rate, angle.z * rate};
}

void checkPose(const XrPosef& pose) {
  require(isUnit(pose.orientation), XR_ERROR_POSE_INVALID, "a space's quaternion has not the length 1");
}

void checkOffered(const Instance& instance, XrReferenceSpaceType type) {
  const auto offered = offeredSpaces(instance);
  require(std::find(offered.begin(), offered.end(), type) != offered.end(), XR_ERROR_REFERENCE_SPACE_UNSUPPORTED,
          "that reference space was not among those that were listed");
}

}  // namespace

std::optional<XrPosef> originAt(Instance& instance, const Space& space, double frame) {
  const Place place = placeOf(instance, space, frame);
  return (place.flags & kValid) != 0 ? std::optional(place.pose) : std::nullopt;
}

XrResult enumerateReferenceSpaces(Instance& instance, XrSession handle, uint32_t capacity, uint32_t* count,
                                  XrReferenceSpaceType* types) {
  sessionOf(instance, handle);
  return enumerate(offeredSpaces(instance), capacity, count, types);
}

XrResult createReferenceSpace(Instance& instance, XrSession handle, const XrReferenceSpaceCreateInfo* info,
                              XrSpace* made) {
  Session& session = sessionOf(instance, handle);
  typed(info, XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
  checkPose(info->poseInReferenceSpace);
  checkOffered(instance, info->referenceSpaceType);
  Space space;
  space.reference = info->referenceSpaceType;
  space.offset = info->poseInReferenceSpace;
  wanted(made) = session.spaces.add(space);
  return XR_SUCCESS;
}

XrResult getReferenceSpaceBoundsRect(Instance& instance, XrSession handle, XrReferenceSpaceType type,
                                     XrExtent2Df* bounds) {
  sessionOf(instance, handle);
  checkOffered(instance, type);
  const bool stage = type == XR_REFERENCE_SPACE_TYPE_STAGE;
  wanted(bounds) = stage ? XrExtent2Df{3, 2} : XrExtent2Df{0, 0};  // m
  return stage ? XR_SUCCESS : XR_SPACE_BOUNDS_UNAVAILABLE;
}

XrResult createActionSpace(Instance& instance, XrSession handle, const XrActionSpaceCreateInfo* info, XrSpace* made) {
  Session& session = sessionOf(instance, handle);
  const Action& action = instance.actions.at(typed(info, XR_TYPE_ACTION_SPACE_CREATE_INFO).action);
  require(action.type == XR_ACTION_TYPE_POSE_INPUT, XR_ERROR_ACTION_TYPE_MISMATCH,
          action.name + ": is no action of poses");
  subactionHand(instance, action, info->subactionPath);
  checkPose(info->poseInActionSpace);
  Space space;
  space.action = info->action;
  space.subaction = info->subactionPath;
  space.offset = info->poseInActionSpace;
  wanted(made) = session.spaces.add(space);
  return XR_SUCCESS;
}

XrResult destroySpace(Instance& instance, XrSpace handle) {
  openSession(instance).spaces.at(handle);
  instance.session->spaces.erase(handle);
  return XR_SUCCESS;
}

XrResult locateSpace(Instance& instance, XrSpace handle, XrSpace base, XrTime time, XrSpaceLocation* location) {
  Session& session = openSession(instance);
  const Space& space = session.spaces.at(handle);
  const Space& origin = session.spaces.at(base);
  require(time > 0, XR_ERROR_TIME_INVALID, "a time must be positive");
  typed(location, XR_TYPE_SPACE_LOCATION);
  const double frame = frameOf(instance, time);
  const Place place = relative(instance, space, origin, frame);
  location->locationFlags = place.flags;
  location->pose = place.pose;
  auto* next = static_cast<XrBaseOutStructure*>(location->next);
  for (; next; next = next->next)
    if (next->type == XR_TYPE_SPACE_VELOCITY)
      fillVelocity(instance, space, origin, frame, *reinterpret_cast<XrSpaceVelocity*>(next));
  return XR_SUCCESS;
}

XrResult locateViews(Instance& instance, XrSession handle, const XrViewLocateInfo* info, XrViewState* state,
                     uint32_t capacity, uint32_t* count, XrView* views) {
  Session& session = sessionOf(instance, handle);
  requireStereo(typed(info, XR_TYPE_VIEW_LOCATE_INFO).viewConfigurationType);
  require(info->displayTime > 0, XR_ERROR_TIME_INVALID, "a time must be positive");
  typed(state, XR_TYPE_VIEW_STATE);
  const double frame = frameOf(instance, info->displayTime);
  const Place base = placeOf(instance, session.spaces.at(info->space), frame);
  state->viewStateFlags = base.flags;  // the bits mean the same for views and for spaces
  return enumerate(kEyes, capacity, count, views, [&](size_t eye, XrView& view) {
    const float half = instance.script.eyeDistance / 2, angle = instance.script.fieldOfView / 2;
    const XrPosef offset = {{0, 0, 0, 1}, {eye == 0 ? -half : half, 0, 0}};
    typed(&view, XR_TYPE_VIEW).pose = combined(inverse(base.pose), combined(instance.script.head(frame), offset));
    view.fov = {-angle, angle, angle, -angle};
  });
}

}  // namespace ps::scripted
