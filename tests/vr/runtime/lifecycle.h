// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/state.h"

// The states of a session (OpenXR specification 1.0, section 9.3). They follow from what the script allows (FOCUSED at
// first: the headset is worn, and nothing lies over the picture), what the client has asked for, and the frames that it
// has submitted; a change goes through all states between.
namespace ps::scripted {

/// From now on the session gets no further than this: IDLE (the headset is taken off), SYNCHRONIZED, VISIBLE (the focus
/// is lost) or FOCUSED. EXITING ends it as if its user chose so in the runtime's menu; LOSS_PENDING announces its loss.
void allow(Instance& instance, XrSessionState state);

void sessionCreated(Instance& instance);
void frameSubmitted(Instance& instance);  ///< one state further, as far as allowed
void exitRequested(Instance& instance);
void sessionEnded(Instance& instance);

}  // namespace ps::scripted
