// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// UInt32: the colour of a particle's own, 0xff000000 + red, green and blue (sRGB); 0: that of its material. There once
/// matter has been given one, and in no state while none has: a scene without colours is what it was before there were
/// any.
inline constexpr const char* kColourField = "colour";

}  // namespace ps
