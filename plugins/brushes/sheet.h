// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "frame.h"

namespace ps::brushes {

/// Stamps sheets across the frame's up, one cell thick and without holes at any pose: the cells that a plane meets
/// along the axis to which it is nearest (a "naive" plane of digital geometry). `inside(side, front)` says in m how far
/// the sheet reaches; no farther than `reach`. The frame follows pen and hand as `how` says, see following().
void stampSheets(const api::StrokeContext& context, const Frame& upright, double how, double reach,
                 const api::List<api::StrokeSample>& samples, api::EditKind kind,
                 const Borrowed<bool(double side, double front)>& inside, api::EditSink& sink);

}  // namespace ps::brushes
