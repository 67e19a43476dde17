// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

namespace ps::render {

/// Text of a file built into the library (shaders, colour maps), by its name without a folder; "" when there is none.
std::string_view embeddedText(std::string_view name);

}  // namespace ps::render
