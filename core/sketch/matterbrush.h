// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/stroke.h"

#include <phasesketch/brush.h>

#include <span>
#include <vector>

namespace ps {

/// Touches that a brush may ask for at a time.
inline constexpr size_t kMostTouches = 50'000;

/// What a brush that works on matter does at places of the hand, in all copies by symmetry: see api::MatterBrush.
/// Throws BrushFault for what the brush itself throws, for more than kMostTouches, and where it is no such brush.
std::vector<api::Touch> touchesOf(const api::BrushPlugin& brush, const StrokeSetup& setup, api::EditKind kind,
                                  std::span<const api::StrokeSample> samples);

}  // namespace ps
