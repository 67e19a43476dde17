// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/brush.h>

namespace ps::brushes {

/// How much smaller a ball is under a light touch, by pressureSize(), the first parameter of its brush.
inline constexpr double kPressureSize = 0.5;

/// Submits the cells of a ball at each sample: those whose centres are within its radius.
void submitBalls(const api::StrokeContext& context, api::EditKind kind, const api::List<api::StrokeSample>& samples,
                 api::EditSink& sink);

}  // namespace ps::brushes
