// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tests/vr/runtime/state.h"

namespace ps::scripted {

/// Checks the layers of a frame (OpenXR specification 1.0, section 10.6), and says for the log what they are. Throws
/// Refusal where one breaks the specification.
nlohmann::json readLayers(Instance& instance, const XrFrameEndInfo& info);

/// Writes what each eye of the frame's first projection layer shows, as PNG into the folder PS_XR_PICTURES: no lens, no
/// other layers. Pixels of sRGB formats are written as they are stored, those of linear ones are encoded.
void takePictures(Instance& instance, const XrFrameEndInfo& info, int64_t frame);

}  // namespace ps::scripted
