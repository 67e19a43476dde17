// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/keptrun.h"
#include "core/simulation/packedframe.h"
#include "core/simulation/runrecord.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

// What the record of a run holds; private to this room.
namespace ps {

class StoredFile;

/// Parameters, tracks or the project as a whole; what becomes of matter alone does not.
bool changesDocument(const RecordedEdit& edit);

struct RunRecord::Impl : KeptRun {
  using Clock = std::chrono::steady_clock;

  struct RawState {
    State state;
    StateBuffer stream;
  };

  explicit Impl(RecordBudget bytes) : budget(std::move(bytes)), counted(std::make_shared<KeptBytes>()) {}
  void loop(const std::stop_token& stop);
  void packState(RawState raw, uint64_t of);
  void packFrame(const SnapshotPtr& snapshot, uint64_t of, FramePacker& packer);
  void clear();
  void forgetAfter(uint64_t frame);
  void keepAsEarlier(uint64_t frame);
  void startAfresh();
  void drop(std::vector<KeptRun>::iterator run);
  KeptRun* runOf(uint64_t number);
  void emptyDisk();
  std::optional<uint64_t> forgetDiskOf(KeptRun& run, uint64_t from, KeptRun& gone);
  bool idle() const { return !busy && waiting.empty() && !waitingState && dropped.empty() && !resized && !forgetsDisk; }

  size_t bytes() const;
  size_t stateBytes() const;
  /// On the thread, without the mutex: nobody waits for the disk.
  void makeRoom();
  std::shared_ptr<const PackedBytes> oldestInMemory();
  bool moved(const PackedBytes& bytes, const std::string& folder);
  // What frees nothing is left alone: a file's frames and states, unless what is kept beside them is itself too much.
  bool headsAreMuch() const { return bytes() - counted->memory > budget.memory / 2; }
  std::vector<KeptRun>::iterator oldestRunThatFrees();
  bool thinFrames();
  bool thinStates();

  RecordBudget budget;
  bool resized = false;      ///< since the thread looked
  bool forgetsDisk = false;  ///< likewise: what lies there is to go
  bool diskFails = false;    ///< until there is another budget
  FrameUnpacker unpacker;
  std::shared_ptr<StoredFile> file;  ///< the thread's; nullptr: nothing was to go to the disk yet
  const ByteCount counted;           ///< of packed bytes
  const std::shared_ptr<const int> lending = std::make_shared<const int>();  ///< held by whoever has all that is kept

  mutable std::mutex mutex;
  std::condition_variable_any wake;
  mutable std::condition_variable done;
  uint64_t revision = 0, begun = 0;
  uint64_t generation = 0;  ///< of what is handed over: what was packed for another one is thrown away
  std::deque<SnapshotPtr> waiting;
  std::optional<RawState> waitingState;
  bool busy = false;
  uint64_t turns = 0;  ///< of the thread

  std::vector<KeptRun> earlier;  ///< the oldest first
  std::vector<KeptRun> dropped;  ///< given back by the thread, without the mutex
  uint64_t runs = 1;             ///< so far
  uint64_t stride = 1, sweep = 0, sweepEnd = 0;
  uint64_t onDisk = 0;  ///< frames before it are not in memory
  bool erased = false;  ///< in this sweep

  std::shared_ptr<const Project> document;  ///< of the last state, while nothing was edited since
  size_t documentEdits = 0;
  double stateTime = 0, stateSeconds = 0, packSeconds = 0;
  Clock::time_point stateAt{};
  uint64_t leftOut = 0;
  std::jthread thread;  // ends first
};

}  // namespace ps
