// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps {

/// What a dragged curve's data are called: its source, as Graph::series has it.
inline constexpr const char* kSourceMime = "application/x-phasesketch-source";

}  // namespace ps
