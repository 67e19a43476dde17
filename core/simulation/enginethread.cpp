// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/engine.h"

#include "core/plugin_host/registry.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <thread>

// Why a thread with a queue: the interface must never wait for a step. Commands are closures that run between frames,
// in order; what the interface reads (snapshot, history, clock) is copied out under a mutex that is held for
// microseconds.
namespace ps {
namespace {

using Clock = std::chrono::steady_clock;

/// After these somebody must look before it goes on.
constexpr StepFlags kPausing =
    static_cast<StepFlags>(StepFlag::NotFinite) | static_cast<StepFlags>(StepFlag::PluginFault);
/// Frames without a flag after which what was told is over, and would be told again.
constexpr int kQuiet = 60;
constexpr size_t kMostEvents = 256;

/// What the exception at hand says.
std::string currentProblem() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return "there is not enough memory for it";
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "an exception that is no std::exception";
  }
}

}  // namespace

struct EngineThread::Impl {
  Impl(PluginRegistry& registry, std::function<void()> callback) : plugins(registry), published(std::move(callback)) {}

  /// `whole`: takes over everything that another such command would, so that one just before it need not run.
  void push(std::function<void()> command, bool whole = false) {
    {
      const std::lock_guard lock(mutex);
      if (whole && !commands.empty() && commands.back().whole) commands.pop_back();
      commands.push_back({std::move(command), whole});
    }
    wake.notify_one();
  }
  void run(const std::stop_token& stop);
  void step();
  void publish(SnapshotPtr snapshot);
  void tell(EngineEvent::Kind kind, StepFlags flags, std::string message);
  void tellOf(const StepReport& report);
  /// Kind and flags of what was told last; Settled when that was nothing.
  EngineEvent standing();
  void settle();
  /// Tells of the exception at hand. Never calls the engine, which may be what failed.
  void fail(EngineEvent::Kind kind, StepFlags flags = 0);
  void halt();
  void pace();
  /// Runs an edit; what cannot be done is told, and the scene stays as it was.
  void edit(const std::function<void(Engine&)>& command);

  PluginRegistry& plugins;
  std::function<void()> published;
  // Engine thread only.
  std::unique_ptr<Engine> engine;
  StepFlags told = 0;  // flags that were told and have been raised since
  int quiet = 0;       // frames without a flag

  std::mutex mutex;
  std::condition_variable_any wake;
  struct Command {
    std::function<void()> run;
    bool whole = false;
  };
  std::deque<Command> commands;
  bool playing = false;
  SnapshotPtr newest, previous;
  std::vector<FrameStats> history;
  std::deque<EngineEvent> events;
  uint64_t eventCount = 0;
  double realTime = 0;
  Clock::time_point due{}, measured{};
  double measuredTime = 0;
  std::jthread thread;
};

void EngineThread::Impl::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::function<void()> command;
    bool advance = false;
    {
      std::unique_lock lock(mutex);
      if (playing) {
        const auto until = due;  // wait_until reads it without the lock, and play() writes due
        wake.wait_until(lock, stop, until, [&] { return !commands.empty(); });
      } else {
        wake.wait(lock, stop, [&] { return !commands.empty() || playing; });
      }
      if (stop.stop_requested()) return;
      if (!commands.empty()) {
        command = std::move(commands.front().run);
        commands.pop_front();
      } else {
        advance = playing && Clock::now() >= due;
      }
    }
    try {
      if (command) command();
      if (advance) {
        step();
        pace();
      }
    } catch (...) {
      halt();
      fail(EngineEvent::Kind::Stopped);
    }
  }
}

void EngineThread::Impl::step() {
  if (!engine) return;
  const StepReport report = engine->step();
  if (report.flags & kPausing) halt();
  tellOf(report);
  SnapshotPtr snapshot = engine->snapshot();
  // Play stops at the end of the scene, once: played from there, it goes on.
  const Project& project = engine->project();
  const double last = project.duration - numberOf(project.solver.parameters, solverParameters(), "dt") / 2;
  if (newest && newest->stats.time < last && snapshot->stats.time >= last) halt();
  publish(std::move(snapshot));
}

/// Real time when the solver can keep up, as fast as it goes when it cannot.
void EngineThread::Impl::pace() {
  const auto now = Clock::now();
  const double dt = engine ? numberOf(engine->project().solver.parameters, solverParameters(), "dt") : 1.0 / 60;
  const std::lock_guard lock(mutex);
  due += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(dt));
  if (due < now) due = now;
  const double elapsed = std::chrono::duration<double>(now - measured).count();
  const double time = newest ? newest->stats.time : 0;
  if (elapsed >= 1) {
    realTime = std::max(0.0, time - measuredTime) / elapsed;
    measured = now;
    measuredTime = time;
  }
}

void EngineThread::Impl::halt() {
  const std::lock_guard lock(mutex);
  playing = false;
}

void EngineThread::Impl::tell(EngineEvent::Kind kind, StepFlags flags, std::string message) {
  const std::lock_guard lock(mutex);
  if (events.size() == kMostEvents) events.pop_front();
  events.push_back({eventCount++, kind, flags, std::move(message)});
}

EngineEvent EngineThread::Impl::standing() {
  const std::lock_guard lock(mutex);
  return events.empty() ? EngineEvent{0, EngineEvent::Kind::Settled, 0, {}} : events.back();
}

void EngineThread::Impl::settle() {
  told = 0;
  quiet = 0;
  if (standing().kind != EngineEvent::Kind::Settled) tell(EngineEvent::Kind::Settled, 0, {});
}

/// A flag may be raised in every frame, or in every third: told once, it is told again after a quiet second only.
void EngineThread::Impl::tellOf(const StepReport& report) {
  quiet = report.flags ? 0 : std::min(quiet + 1, kQuiet + 1);
  if (report.flags & (~told | kPausing)) tell(EngineEvent::Kind::Step, report.flags, report.message);
  told |= report.flags;
  if (quiet != kQuiet) return;
  told = 0;
  const EngineEvent::Kind kind = standing().kind;
  if (kind == EngineEvent::Kind::Step || kind == EngineEvent::Kind::Stopped) settle();
}

void EngineThread::Impl::publish(SnapshotPtr snapshot) {
  const bool fresh = !newest || newest->revision != snapshot->revision;
  if (fresh) settle();  // told of a run that is over
  {
    const std::lock_guard lock(mutex);
    if (fresh) {
      history.clear();
      previous = nullptr;
    } else {
      previous = newest;
    }
    if (!history.empty() && history.back().frame == snapshot->stats.frame) history.pop_back();  // edited since
    history.push_back(snapshot->stats);
    newest = std::move(snapshot);
  }
  if (published) published();
}

void EngineThread::Impl::fail(EngineEvent::Kind kind, StepFlags flags) {
  tell(kind, flags, currentProblem());
  if (published) published();
}

void EngineThread::Impl::edit(const std::function<void(Engine&)>& command) {
  if (!engine) return;
  try {
    command(*engine);
  } catch (const PluginError&) {
    halt();
    return fail(EngineEvent::Kind::Refused, static_cast<StepFlags>(StepFlag::PluginFault));
  } catch (...) {
    return fail(EngineEvent::Kind::Refused);
  }
  // An edit that works mends a refusal and what made the scene pause; flags of running steps end by themselves.
  const EngineEvent last = standing();
  if (!(last.flags & ~kPausing)) settle();
  publish(engine->snapshot());
}

EngineThread::EngineThread(PluginRegistry& plugins, std::function<void()> published)
    : m(std::make_unique<Impl>(plugins, std::move(published))) {
  m->thread = std::jthread([impl = m.get()](const std::stop_token& stop) { impl->run(stop); });
}

EngineThread::~EngineThread() {
  m->thread.request_stop();
  m->thread.join();
}

void EngineThread::open(const Project& project, bool play) {
  m->push([impl = m.get(), project, play] {
    try {
      auto engine = std::make_unique<Engine>(project, impl->plugins);
      impl->engine = std::move(engine);
    } catch (...) {
      impl->engine.reset();
      impl->halt();
      auto empty = std::make_shared<Snapshot>();
      empty->revision = nextRevision();
      impl->publish(std::move(empty));
      impl->fail(EngineEvent::Kind::NotOpened);
      return;
    }
    {
      const std::lock_guard lock(impl->mutex);
      impl->newest = impl->previous = nullptr;
      impl->playing = play;
      impl->due = impl->measured = Clock::now();
      impl->measuredTime = 0;
    }
    impl->publish(impl->engine->snapshot());
  });
}

void EngineThread::play() {
  {
    const std::lock_guard lock(m->mutex);
    m->playing = true;
    m->due = m->measured = Clock::now();
    m->measuredTime = m->newest ? m->newest->stats.time : 0;
  }
  m->wake.notify_one();
}

void EngineThread::pause() {
  const std::lock_guard lock(m->mutex);
  m->playing = false;
}

void EngineThread::stepOnce() {
  pause();
  m->push([impl = m.get()] { impl->step(); });
}

void EngineThread::reset() {
  m->push([impl = m.get()] { impl->edit([](Engine& engine) { engine.reset(); }); });
}

void EngineThread::setParameter(const Address& address, const Value& value) {
  m->push(
      [impl = m.get(), address, value] { impl->edit([&](Engine& engine) { engine.setParameter(address, value); }); });
}

void EngineThread::update(const Project& project) {
  m->push([impl = m.get(), project] { impl->edit([&](Engine& engine) { engine.update(project); }); }, true);
}

void EngineThread::post(std::function<void(Engine&)> command) {
  m->push([impl = m.get(), command = std::move(command)] { impl->edit(command); });
}

bool EngineThread::playing() const {
  const std::lock_guard lock(m->mutex);
  return m->playing;
}

SnapshotPtr EngineThread::snapshot() const {
  const std::lock_guard lock(m->mutex);
  return m->newest;
}

SnapshotPtr EngineThread::previousSnapshot() const {
  const std::lock_guard lock(m->mutex);
  return m->previous;
}

std::vector<FrameStats> EngineThread::history(size_t from) const {
  const std::lock_guard lock(m->mutex);
  if (from >= m->history.size()) return {};
  return {m->history.begin() + static_cast<std::ptrdiff_t>(from), m->history.end()};
}

std::vector<EngineEvent> EngineThread::events(uint64_t from) const {
  const std::lock_guard lock(m->mutex);
  const auto first = std::find_if(m->events.begin(), m->events.end(),
                                  [from](const EngineEvent& event) { return event.number >= from; });
  return {first, m->events.end()};
}

double EngineThread::realTimeFactor() const {
  const std::lock_guard lock(m->mutex);
  return m->playing ? m->realTime : 0;
}

}  // namespace ps
