// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"

#include <cstdint>
#include <vector>

namespace ps {

/// What each frame of a run measured, in at most kMost entries however long it runs: the newest kNewest frames are all
/// there; of those before, when there is no room any more, every second one goes, then every second one of the rest.
class FrameHistory {
 public:
  static constexpr size_t kMost = size_t{1} << 16, kNewest = size_t{1} << 14;

  void clear();
  /// Frames ascend; the number of the last one again replaces it.
  void add(const FrameStats& stats);
  void cutAfter(uint64_t frame);
  /// From frame number `frame` on, the first `most` of them.
  std::vector<FrameStats> since(uint64_t frame, size_t most = kMost) const;
  size_t size() const { return m_frames.size(); }

 private:
  void thin();
  std::vector<FrameStats> m_frames;
  uint64_t m_stride = 1;  ///< of what is older than the newest
};

}  // namespace ps
