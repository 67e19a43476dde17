// SPDX-License-Identifier: Apache-2.0
#include "core/export/recordedframes.h"

#include "core/base/progress.h"
#include "core/simulation/packedframe.h"

#include <algorithm>
#include <iterator>

namespace ps {

std::vector<RangeFrame> framesIn(const KeptRun& run, const FrameRange& range) {
  std::vector<RangeFrame> frames;
  if (run.frames.empty()) return frames;
  const uint64_t last = std::min(range.last, run.frames.rbegin()->first);
  for (uint64_t wanted = range.first; wanted <= last; wanted += range.every) {
    const auto after = run.frames.upper_bound(wanted);
    if (after != run.frames.begin()) frames.push_back({wanted, std::prev(after)->first});
  }
  return frames;
}

std::vector<uint64_t> keptIn(const KeptRun& run, const FrameRange& range) {
  std::vector<uint64_t> numbers;
  for (const RangeFrame& frame : framesIn(run, range))
    if (numbers.empty() || numbers.back() != frame.kept) numbers.push_back(frame.kept);
  return numbers;
}

size_t exportFrames(const KeptRun& run, const FrameRange& range, FrameExporter& exporter) {
  const std::vector<uint64_t> numbers = keptIn(run, range);
  beginStage("Exporting", 1, static_cast<double>(numbers.size()));
  const FrameUnpacker unpacker;
  try {
    for (const uint64_t number : numbers) {
      exporter.add(*unpacker.snapshot(*run.frames.at(number), 1));
      advance(1);
    }
  } catch (const std::exception&) {
    try {
      exporter.finish();
    } catch (const Error&) {
      // What stopped it before is what to say.
    }
    throw;
  }
  exporter.finish();
  return numbers.size();
}

}  // namespace ps
