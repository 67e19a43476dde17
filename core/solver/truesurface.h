// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace ps::field {

/// Float4 of fixed particles that stand still: the unit normal of the surface of their shape at its nearest place, and
/// how deep they lie below it, m; 0 where that is not known. Contact then slides along the shape rather than along
/// particles. Only stores of scenes with such shapes have it.
inline constexpr const char* kTrueSurface = "true_surface";

}  // namespace ps::field
