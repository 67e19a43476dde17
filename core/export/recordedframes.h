// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/export/exportformat.h"
#include "core/simulation/keptrun.h"
#include "core/simulation/snapshot.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace ps {

/// Which frames of a run: by their numbers, from the first one on every so many. Where one is not kept, the kept one
/// before it is meant, once.
struct FrameRange {
  uint64_t first = 0, last = 0, every = 1;
};

/// Numbers of the kept frames that are meant.
std::vector<uint64_t> framesIn(const KeptRun& run, const FrameRange& range);

/// Unpacks each and hands it over. The thread's progress counts them; throws Cancelled, and InputError for a frame
/// whose bytes are not what was written.
void forFrames(const KeptRun& run, const FrameRange& range, const std::function<void(const Snapshot&)>& each);

/// Writes them, as one stage of the thread's progress, and returns how many; the series is whole as far as it goes when
/// it is cancelled too. Throws Cancelled and what the exporter throws.
size_t exportFrames(const KeptRun& run, const FrameRange& range, FrameExporter& exporter);

}  // namespace ps
