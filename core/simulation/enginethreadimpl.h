// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/callwatch.h"
#include "core/simulation/commandqueue.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/framehistory.h"
#include "core/simulation/runrecord.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

// What an engine's thread holds; private to this room.
namespace ps {

struct EngineThread::Impl {
  static constexpr double kPatience = 10;  // s that a plugin may take for one call

  Impl(PluginRegistry& registry, std::function<void()> callback, RecordBudget budget)
      : plugins(registry),
        published(std::move(callback)),
        record(std::move(budget)),
        watch(
            kPatience, [this](const std::string& id) { isLate(id); }, [this](const std::string& id) { isBack(id); }) {}

  template <class Item>
  void push(Item item, uint64_t commands = 0) {
    {
      const std::lock_guard lock(mutex);
      queue.push(std::move(item));
      cost.commands += commands;
    }
    wake.notify_one();
  }
  void run(const std::stop_token& stop);
  void turn();
  void workOff();
  void step();
  void open(const Opening& opening);
  /// Makes a scene, watched: whoever makes one calls engines only within it.
  void make(const std::function<void()>& makeScene);
  void remake(const Reset& start);
  void goBack(const GoBack& to);
  void adopt(const Adoption& recording);
  /// The scene is at a frame of the record, of which all up to it is kept, with the project as it is by now.
  void standAt(const Project& project, bool edits, bool wholeHistory, bool play);
  /// An edit was made: into the record, or with it another run has begun.
  void recordEdit(RecordedEdit edit);
  void recordRun();
  void noScene(const EngineEvent& failure);
  /// Play ends with the snapshot that ends the scene: whoever sees it paused sees that one.
  void publish(SnapshotPtr snapshot, bool ends = false);
  void publishEdits();
  void notify(EngineEvent event);  // gives it its number
  void tellOf(const StepReport& report);
  /// Kind and flags of what was reported last; Settled when that was nothing.
  EngineEvent standing();
  void settle();
  /// What was reported of one run is over with the next.
  void follow(uint64_t revision);
  /// Tells of what failed, and pauses where a plugin failed in an edit. Never calls the engine, which may be just that.
  void fail(EngineEvent event);
  void halt();
  // On the watching thread.
  void isLate(const std::string& id);
  void isBack(const std::string& id);
  void pace();
  bool frameIsDue(double ahead = 0);
  /// Makes an edit. Returns what is to be reported of one that cannot be made: the scene then stays as it was. `mends`:
  /// once it is made, what was refused before no longer stands.
  template <class Action>
  std::optional<EngineEvent> edit(Action action, bool mends = true);
  void change(const Command& command);
  void editAll(const ParameterBatch& batch);
  void look(const Command& command);
  void answer(const Question& question);

  PluginRegistry& plugins;
  std::function<void()> published;
  // Engine thread only.
  std::unique_ptr<Engine> engine;
  StepFlags reported = 0;           // flags that were reported and have been raised since
  int quiet = 0;                    // frames without a flag
  uint64_t reportedOf = 0;          // Engine::revision() of what was reported
  std::optional<ShowFields> shown;  // asked for since the scene was opened
  RunRecord record;
  std::stop_token stopping;
  bool edited = false;  // since the last snapshot
  double snapshotSeconds = 0;

  std::mutex mutex;
  std::condition_variable_any wake;
  CommandQueue queue;
  EditCost cost;
  bool playing = false;
  double speed = 1;                  // s per s
  std::shared_ptr<Progress> making;  // nullptr: none is
  SnapshotPtr newest, previous;
  FrameHistory history;
  std::deque<EngineEvent> events;
  uint64_t eventCount = 0;
  double realTime = 0;
  std::chrono::steady_clock::time_point due{}, measured{};
  double measuredTime = 0;
  std::jthread thread;
  CallWatch watch;
};

}  // namespace ps
