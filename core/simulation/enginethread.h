// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/progress.h"
#include "core/simulation/command.h"
#include "core/simulation/events.h"
#include "core/simulation/framehistory.h"
#include "core/simulation/snapshot.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace ps {

class Engine;
class PluginRegistry;
class RunRecord;
struct RecordBudget;
struct RunContent;

/// What a thread's edits have cost so far.
struct EditCost {
  uint64_t commands = 0;  ///< received
  uint64_t applied = 0;   ///< edits made of them: what waits together for one address is one
  uint64_t baked = 0;     ///< tables of materials
  double seconds = 0;     ///< of the engine's thread, without snapshots
};

/// Runs an Engine on its own thread. Commands are queued and act between frames; a snapshot is published after each
/// frame, and when the queue is empty after edits. No call here waits for a step.
class EngineThread {
 public:
  /// `published` is called on the engine's thread after each new snapshot and event, and when making a scene begins.
  EngineThread(PluginRegistry& plugins, std::function<void()> published);
  EngineThread(PluginRegistry& plugins, std::function<void()> published, RecordBudget budget);  ///< of its record
  ~EngineThread();

  /// Replaces the scene; one that is being made is given up. A project that holds a state opens there, paused: who kept
  /// a moment wants to see it; an event says what is to be reported of the state. A scene that cannot be built leaves
  /// none: an event says why, the snapshot is then empty, of a new revision and without body ids, and the thread
  /// pauses.
  void open(const Project& project, bool play);
  void play();
  void pause();
  void stepOnce();
  /// Simulated seconds per second that it plays at where it can keep up; 1 at first, positive.
  void setSpeed(double speed);
  /// An edit, after those that came before. One of a parameter replaces a waiting one of the same address, and
  /// those that wait side by side are made as one; an UpdateProject replaces what it would overwrite.
  void apply(Command command);
  void reset();
  void setParameter(const Address& address, const Value& value);
  void update(const Project& project);
  /// Looks at the engine between frames, after the edits that came before.
  void ask(std::function<void(const Engine&)> question);

  /// What the run was at each frame, as far as it is kept; a reset, an opening and a return to a state begin anew.
  const RunRecord& recording() const;
  void setRecordBudget(RecordBudget budget);
  void forgetRecordedOnDisk();
  /// Goes on from a recorded frame: the state before it, and all edits since, again up to that frame. Then the project
  /// acts as it is by now: going back in time takes back no edit. The run as it was is kept beside it.
  void continueFrom(uint64_t frame, bool play);
  /// The same with an earlier run, at its end; the present one is then the earlier one.
  void goOnWith(uint64_t run);
  void forgetRun(uint64_t run);
  void renameRun(uint64_t run, const std::string& name);
  /// A state of now goes into the record, whether or not one is due.
  void keepState();
  /// The record becomes that of a run that was recorded elsewhere, and the scene stands at its end. Then the project
  /// acts as it is; `same`: it is the one that the recording is of. Where that cannot be, an event says why, and all
  /// stays as it was. `adopted` is called on the engine's thread when it stands there.
  void adopt(std::shared_ptr<const RunContent> content, bool same, std::function<void()> adopted = {});

  /// How far the scene is that is being made, by an opening, a reset or a return to a state or frame; nothing when none
  /// is.
  std::optional<Progress::State> making() const;
  /// Ends that: an event says so. What cannot stand beside the scene before it has taken its place; else that one
  /// stays.
  void cancelMaking();

  bool playing() const;
  SnapshotPtr snapshot() const;          ///< newest; nullptr before the first
  SnapshotPtr previousSnapshot() const;  ///< the one before it, of the same revision, else nullptr
  /// Statistics of the frames since the last reset, from number `frame` on; of a long run some are left out, see
  /// FrameHistory. An edit between two frames replaces the last entry. The first `most` of them: all of a long run are
  /// too many for one turn of a thread that draws.
  std::vector<FrameStats> history(uint64_t frame, size_t most = FrameHistory::kMost) const;
  /// Failures in the order they came, from number `from` on; the oldest are forgotten after a few hundred. A step's
  /// flag is reported when it is raised after a second without it. The thread pauses at a NaN and when a plugin fails.
  std::vector<EngineEvent> events(uint64_t from) const;
  double realTimeFactor() const;  ///< simulated seconds per second, over the last second
  EditCost editCost() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m;
};

}  // namespace ps
