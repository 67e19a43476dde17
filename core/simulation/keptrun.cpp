// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/keptrun.h"

#include "core/simulation/packedframe.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ps {
namespace {

/// About what an edit holds; whole projects are by far the largest.
size_t bytesOf(const FrameEdit& edit) {
  constexpr size_t kSmall = 256, kProject = 1 << 15, kCell = 12;
  size_t bytes = sizeof edit + kSmall;
  const auto* command = std::get_if<Command>(&edit.edit);
  if (command && std::holds_alternative<UpdateProject>(*command)) bytes += kProject;
  bytes += kCell * cellsOf(edit);
  if (const auto* touch = command ? std::get_if<TouchMatter>(command) : nullptr)
    bytes += sizeof(api::Touch) * (touch->path.size() + touch->still.size());
  return bytes;
}

}  // namespace

size_t cellsOf(const FrameEdit& edit) {
  const auto* command = std::get_if<Command>(&edit.edit);
  if (!command) return 0;
  return std::visit(
      [](const auto& one) -> size_t {
        if constexpr (requires { CellIndices(one.cells); }) return one.cells.size();
        return 0;
      },
      *command);
}

void KeptRun::addFrame(std::shared_ptr<const PackedFrame> frame) {
  const uint64_t key = frame->stats.frame;
  if (const auto known = frames.find(key); known != frames.end()) eraseFrame(known);
  frameBytes += frame->bytes();
  frames.emplace(key, std::move(frame));
}

void KeptRun::eraseFrame(Frames::iterator frame) {
  frameBytes -= frame->second->bytes();
  frames.erase(frame);
}

void KeptRun::addEdit(FrameEdit edit) {
  editBytes += bytesOf(edit);
  edits.push_back(std::move(edit));
}

void KeptRun::eraseEditsAfter(uint64_t frame) {
  while (!edits.empty() && edits.back().frame > frame) {
    editBytes -= bytesOf(edits.back());
    edits.pop_back();
  }
}

/// Times ascend with numbers, and mostly evenly: a search among them by halves of the numbers.
KeptRun::Frames::const_iterator KeptRun::frameAt(double time) const {
  if (frames.empty()) return frames.end();
  uint64_t low = frames.begin()->first, high = frames.rbegin()->first;
  while (low < high) {
    const uint64_t middle = low + (high - low) / 2;
    const auto at = frames.lower_bound(middle);
    if (at->second->stats.time < time && at->first < high) {
      low = at->first + 1;
    } else if (at->second->stats.time < time) {
      low = high;
    } else {
      high = middle;
    }
  }
  const auto next = frames.lower_bound(low);
  if (next == frames.end()) return std::prev(next);
  if (next == frames.begin()) return next;
  const auto before = std::prev(next);
  return time - before->second->stats.time <= next->second->stats.time - time ? before : next;
}

std::optional<RestorePoint> KeptRun::restorePoint(uint64_t frame) const {
  const auto after =
      std::find_if(states.begin(), states.end(), [&](const State& state) { return state.frame > frame; });
  if (after == states.begin()) return std::nullopt;
  const State& state = *std::prev(after);
  RestorePoint point{state.frame, frame, state.document, state.names, state.stream, {}};
  for (size_t k = state.edits; k < edits.size() && edits[k].frame <= frame; ++k) point.edits.push_back(edits[k]);
  return point;
}

}  // namespace ps
