// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/snapshot.h"
#include "core/solver/solver.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ps {

class PluginRegistry;

/// A scene compiled into a solver, single-threaded from the caller's point of view: the command line uses it directly,
/// the editor through EngineThread.
class Engine {
 public:
  /// Throws InputError when the project cannot be compiled (contradicting values, too many particles, ...).
  Engine(const Project& project, PluginRegistry& plugins);
  ~Engine();

  /// Plugins that threw in it are refused from now on, in the registry too.
  StepReport step();

  // Edits. Each throws, InputError mostly, and then has changed nothing.

  void reset();  ///< back to the start, with all edits kept
  /// The document changed as a whole (undo, a new body, gravity): takes over every parameter and material at once;
  /// bodies, which are particles by now, at the next reset; how fixed ones move acts at once.
  void update(const Project& project);
  /// A parameter changed: recompiles what it touches. Returns false when it acts at the next reset only
  /// (body parameters but motion_start, motion_stop, heating_power and surface_area; particle_spacing).
  bool setParameter(const Address& address, const Value& value);
  /// Adds a sketched body, or more cells of one that exists, at rest; cells where a live particle is within 0.9
  /// spacings stay free. Returns the ids of the new particles.
  std::vector<uint32_t> addCells(const Body& body, const std::vector<std::array<int, 3>>& cells, int palette);
  /// Adds a body as it is at the start, without what would stand within 0.9 spacings of a live particle. Returns the
  /// ids of the new particles.
  std::vector<uint32_t> addBody(const Body& body);
  /// Removes particles and keeps them, with all their fields and bonds, for putBack(). Until the next reset. What an
  /// emitter holds stays.
  TakenMatter takeParticles(const std::vector<uint32_t>& ids);
  void putBack(const TakenMatter& matter);
  /// Ids of live particles whose centre lies in one of the cells of a lattice.
  std::vector<uint32_t> particlesIn(const VoxelShape& lattice, const std::vector<std::array<int, 3>>& cells) const;

  SnapshotPtr snapshot() const;
  FrameStats stats() const;
  const Project& project() const;
  Solver& solver();
  /// Body::id by the index that particles carry; a body keeps its index until the next reset.
  const std::vector<std::string>& bodyIds() const;
  const std::vector<std::string>& probeNames() const;  ///< "name.quantity[unit]"

 private:
  struct Impl;
  std::unique_ptr<Impl> m;
};

/// What an engine's thread has to tell. The newest one stands until another follows.
struct EngineEvent {
  enum class Kind {
    Step,       ///< a step raised flags
    Refused,    ///< an edit was refused and has changed nothing
    NotOpened,  ///< a project could not be built; there is no scene
    Stopped,    ///< something failed between two frames or in one; the scene is paused
    Settled,    ///< what was told last no longer holds
  };
  uint64_t number = 0;  ///< counts the thread's events
  Kind kind = Kind::Step;
  StepFlags flags = 0;  ///< of steps; PluginFault of edits that a plugin failed in
  std::string message;
};

/// Runs an Engine on its own thread. Commands are queued and act between frames; snapshots are published after each.
/// No call here waits for a step.
class EngineThread {
 public:
  /// `published` is called on the engine's thread after each new snapshot.
  EngineThread(PluginRegistry& plugins, std::function<void()> published);
  ~EngineThread();

  /// Replaces the scene. One that cannot be built leaves none: an event says why, the snapshot is then empty, of a new
  /// revision and without body ids, and the thread pauses.
  void open(const Project& project, bool play);
  void play();
  void pause();
  void stepOnce();
  void reset();
  void setParameter(const Address& address, const Value& value);
  void update(const Project& project);
  /// Any other work between frames: strokes, erasures.
  void post(std::function<void(Engine&)> command);

  bool playing() const;
  SnapshotPtr snapshot() const;          ///< newest; nullptr before the first
  SnapshotPtr previousSnapshot() const;  ///< the one before it, of the same revision, else nullptr
  /// All frames' statistics since the last reset, appended from index `from`. An edit between two frames replaces the
  /// last entry.
  std::vector<FrameStats> history(size_t from) const;
  /// Failures in the order they came, from number `from` on; the oldest are forgotten after a few hundred. A step's
  /// flag is told when it is raised after a second without it. The thread pauses at a NaN and when a plugin fails.
  std::vector<EngineEvent> events(uint64_t from) const;
  double realTimeFactor() const;  ///< simulated seconds per second, over the last second

 private:
  struct Impl;
  std::unique_ptr<Impl> m;
};

}  // namespace ps
