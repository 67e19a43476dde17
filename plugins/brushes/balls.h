// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "stamping.h"

namespace ps::brushes {

/// Of a brush of balls.
inline constexpr double kPressureSize = 0.5;
inline constexpr api::ParameterDeclaration kBallParameters[] = {pressureSize(
    kPressureSize, "How far a light touch of the pen makes the ball smaller; a mouse always presses fully.")};

/// Submits the cells of a ball at each sample: those whose centres are within its radius.
void submitBalls(const api::StrokeContext& context, api::EditKind kind, const api::List<api::StrokeSample>& samples,
                 api::EditSink& sink);

}  // namespace ps::brushes
