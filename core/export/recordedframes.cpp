// SPDX-License-Identifier: Apache-2.0
#include "core/export/recordedframes.h"

#include "core/base/progress.h"
#include "core/simulation/packedframe.h"

#include <algorithm>
#include <iterator>

namespace ps {

std::vector<uint64_t> framesIn(const KeptRun& run, const FrameRange& range) {
  std::vector<uint64_t> numbers;
  if (run.frames.empty()) return numbers;
  const uint64_t last = std::min(range.last, run.frames.rbegin()->first);
  for (uint64_t wanted = range.first; wanted <= last; wanted += range.every) {
    const auto after = run.frames.upper_bound(wanted);
    if (after == run.frames.begin()) continue;
    const uint64_t number = std::prev(after)->first;
    if (numbers.empty() || numbers.back() != number) numbers.push_back(number);
  }
  return numbers;
}

void forFrames(const KeptRun& run, const FrameRange& range, const std::function<void(const Snapshot&)>& each) {
  const std::vector<uint64_t> numbers = framesIn(run, range);
  for (const uint64_t number : numbers) {
    each(*run.frames.at(number)->snapshot(1));
    advance(1);
  }
}

size_t exportFrames(const KeptRun& run, const FrameRange& range, FrameExporter& exporter) {
  const size_t count = framesIn(run, range).size();
  beginStage("Exporting", 1, static_cast<double>(count));
  try {
    forFrames(run, range, [&](const Snapshot& snapshot) { exporter.add(snapshot); });
  } catch (const Cancelled&) {
    exporter.finish();
    throw;
  }
  exporter.finish();
  return count;
}

}  // namespace ps
