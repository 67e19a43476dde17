// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/export/exportformat.h"
#include "core/simulation/keptrun.h"

#include <cstdint>
#include <vector>

namespace ps {

/// Which frames of a run: by their numbers, from the first one on every so many.
struct FrameRange {
  uint64_t first = 0, last = 0, every = 1;
};

/// A frame that is meant, and the one that is kept of it: where it is not kept itself, the last one before it.
struct RangeFrame {
  uint64_t wanted = 0, kept = 0;
};
/// Those from the first kept one on, up to the last.
std::vector<RangeFrame> framesIn(const KeptRun& run, const FrameRange& range);
/// Each kept one once.
std::vector<uint64_t> keptIn(const KeptRun& run, const FrameRange& range);

/// Writes each kept one, as one stage of the thread's progress, and returns how many; the series is whole as far as it
/// goes when it is cancelled or fails too. Throws Cancelled and what the exporter throws.
size_t exportFrames(const KeptRun& run, const FrameRange& range, FrameExporter& exporter);

}  // namespace ps
