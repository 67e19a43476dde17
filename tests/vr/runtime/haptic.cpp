// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/functions.h"
#include "tests/vr/runtime/profiles.h"
#include "tests/vr/runtime/sources.h"

// What controllers would let feel (OpenXR specification 1.0, section 11.6): the log has all of it.
namespace ps::scripted {
namespace {

constexpr double kNanosecond = 1e-9;  // s

std::vector<Source> outputsOf(Instance& instance, XrSession handle, const XrHapticActionInfo* info) {
  sessionOf(instance, handle);
  const Action& action = instance.actions.at(typed(info, XR_TYPE_HAPTIC_ACTION_INFO).action);
  require(instance.actionSets.at(action.set).attached, XR_ERROR_ACTIONSET_NOT_ATTACHED,
          action.name + ": its action set is not attached");
  require(action.type == XR_ACTION_TYPE_VIBRATION_OUTPUT, XR_ERROR_ACTION_TYPE_MISMATCH,
          action.name + ": is no action of vibration");
  return sourcesOf(instance, info->action, subactionHand(instance, action, info->subactionPath));
}

}  // namespace

XrResult applyHapticFeedback(Instance& instance, XrSession handle, const XrHapticActionInfo* info,
                             const XrHapticBaseHeader* header) {
  const std::vector<Source> outputs = outputsOf(instance, handle, info);
  const auto& vibration = *reinterpret_cast<const XrHapticVibration*>(&typed(header, XR_TYPE_HAPTIC_VIBRATION));
  require(vibration.amplitude >= 0 && vibration.amplitude <= 1, XR_ERROR_VALIDATION_FAILURE,
          "the amplitude of a vibration is 0 to 1");
  require(vibration.frequency >= 0 && (vibration.duration > 0 || vibration.duration == XR_MIN_HAPTIC_DURATION),
          XR_ERROR_VALIDATION_FAILURE, "a vibration has a negative frequency or no duration");
  if (instance.session->state != XR_SESSION_STATE_FOCUSED) return XR_SESSION_NOT_FOCUSED;
  const bool shortest = vibration.duration == XR_MIN_HAPTIC_DURATION;
  for (const Source& output : outputs)
    instance.log.write({{"haptic", std::string(kHands[output.hand]) + output.component},
                        {"amplitude", vibration.amplitude},
                        {"frequency", vibration.frequency},
                        {"duration", shortest ? 0 : kNanosecond * double(vibration.duration)},
                        {"frame", instance.frame}});
  return XR_SUCCESS;
}

XrResult stopHapticFeedback(Instance& instance, XrSession handle, const XrHapticActionInfo* info) {
  const std::vector<Source> outputs = outputsOf(instance, handle, info);
  if (instance.session->state != XR_SESSION_STATE_FOCUSED) return XR_SESSION_NOT_FOCUSED;
  for (const Source& output : outputs)
    instance.log.write(
        {{"haptic", std::string(kHands[output.hand]) + output.component}, {"amplitude", 0}, {"frame", instance.frame}});
  return XR_SUCCESS;
}

}  // namespace ps::scripted
