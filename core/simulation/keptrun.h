// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/runrecord.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace ps {

struct PackedFrame;
class PackedBytes;

/// What is kept of one run. A copy shares what is packed.
struct KeptRun {
  struct State {
    uint64_t frame = 0;
    size_t edits = 0;  ///< that were in it
    std::shared_ptr<const Project> document;
    std::shared_ptr<const NamedMatter> names;
    std::shared_ptr<const PackedBytes> stream;
  };
  using Frames = std::map<uint64_t, std::shared_ptr<const PackedFrame>>;

  void addFrame(std::shared_ptr<const PackedFrame> frame);  ///< in place of one of its number
  void eraseFrame(Frames::iterator frame);
  void addEdit(FrameEdit edit);
  void eraseEditsAfter(uint64_t frame);
  /// From the nearest state; nothing where no state before the frame is kept.
  std::optional<RestorePoint> restorePoint(uint64_t frame) const;
  /// The frame next to a time; end() where there are none.
  Frames::const_iterator frameAt(double time) const;
  size_t bytes() const { return frameBytes + editBytes; }  ///< beside the packed ones

  uint64_t number = 1;
  std::string name;
  double apart = 0;      ///< s, where it left the present run
  uint64_t adopted = 0;  ///< frames before it may lie in somebody else's file
  Frames frames;
  size_t frameBytes = 0;
  std::vector<State> states;  ///< ascending by frame
  std::vector<FrameEdit> edits;
  size_t editBytes = 0;
};

/// All runs of a record.
struct RunContent {
  KeptRun present;
  std::vector<KeptRun> earlier;        ///< the oldest first
  uint64_t runs = 1;                   ///< so far: the number of the last one
  std::shared_ptr<const void> lent{};  ///< by the record that shares it, which thins nothing meanwhile
  uint64_t begun = 0;                  ///< RunRecord::begun(), when it was taken
};

}  // namespace ps
