// SPDX-License-Identifier: MIT
#pragma once

namespace ps::api {

/// Capabilities of structure for what is one particle thick: extension(kHoldsSheets), extension(kHoldsLines) is a
/// ThinMatter. A new sheet or rope is held by the first such plugin that is installed.
inline constexpr const char* kHoldsSheets = "holds_sheets";
inline constexpr const char* kHoldsLines = "holds_lines";
struct ThinMatter {
  const char* material;  ///< id of the one that a new sheet or rope is of, where it is installed
};

}  // namespace ps::api
