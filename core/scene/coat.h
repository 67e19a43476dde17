// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/vector.h"

#include <cstdint>
#include <string>

// What matter is painted: the id of a material that it becomes of, or a colour of its own, "#rrggbb" (sRGB), which it
// has whatever becomes of it. No id begins with that sign.
namespace ps {

/// Matter has the colour of its material again.
inline constexpr const char* kNoColour = "#";

bool isColour(const std::string& coat);
/// The coat of a red, green and blue of 0 .. 1; kNoColour where one is below 0 or none.
std::string colourCoat(const Vector3& rgb);
/// As the field of particles has it: 0 without a colour, else 0xff000000 + red, green and blue.
uint32_t colourNumber(const std::string& coat);
/// What undo paints; of a number of the field.
std::string coatOf(uint32_t colour);

}  // namespace ps
