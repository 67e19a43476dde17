// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/engine.h"

#include "core/base/error.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

// Why a thread with a queue: the interface must never wait for a step. Commands are closures that run between frames,
// in order; what the interface reads (snapshot, history, clock) is copied out under a mutex that is held for
// microseconds.
namespace ps {
namespace {
using Clock = std::chrono::steady_clock;
}

struct EngineThread::Impl {
  Impl(PluginRegistry& registry, std::function<void()> callback) : plugins(registry), published(std::move(callback)) {}

  void push(std::function<void()> command) {
    {
      const std::lock_guard lock(mutex);
      commands.push_back(std::move(command));
    }
    wake.notify_one();
  }
  void run(const std::stop_token& stop);
  void step();
  void publish(SnapshotPtr snapshot);
  void fail(const std::string& message);
  void pace();
  /// Runs an edit; what cannot be done is told in the next snapshot, and the scene stays as it was.
  void edit(const std::function<void(Engine&)>& command);

  PluginRegistry& plugins;
  std::function<void()> published;
  std::unique_ptr<Engine> engine;  // engine thread only

  std::mutex mutex;
  std::condition_variable_any wake;
  std::deque<std::function<void()>> commands;
  bool playing = false;
  SnapshotPtr newest, previous;
  std::vector<FrameStats> history;
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
        wake.wait_until(lock, stop, due, [&] { return !commands.empty(); });
      } else {
        wake.wait(lock, stop, [&] { return !commands.empty() || playing; });
      }
      if (stop.stop_requested()) return;
      if (!commands.empty()) {
        command = std::move(commands.front());
        commands.pop_front();
      } else {
        advance = playing && Clock::now() >= due;
      }
    }
    if (command) command();
    if (advance) {
      step();
      pace();
    }
  }
}

void EngineThread::Impl::step() {
  if (!engine) return;
  const StepReport report = engine->step();
  constexpr auto kFatal = static_cast<StepFlags>(StepFlag::NotFinite);
  if (report.flags & kFatal) {
    const std::lock_guard lock(mutex);
    playing = false;
  }
  publish(engine->snapshot());
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

void EngineThread::Impl::publish(SnapshotPtr snapshot) {
  {
    const std::lock_guard lock(mutex);
    if (!newest || newest->revision != snapshot->revision) {
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

void EngineThread::Impl::fail(const std::string& message) {
  auto snapshot = engine ? std::make_shared<Snapshot>(*engine->snapshot()) : std::make_shared<Snapshot>();
  snapshot->message = message;
  publish(snapshot);
}

void EngineThread::Impl::edit(const std::function<void(Engine&)>& command) {
  if (!engine) return;
  try {
    command(*engine);
    publish(engine->snapshot());
  } catch (const std::exception& error) {
    fail(error.what());
  }
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
    } catch (const std::exception& error) {
      impl->engine.reset();
      auto empty = std::make_shared<Snapshot>();
      empty->revision = nextRevision();
      empty->message = error.what();
      {
        const std::lock_guard lock(impl->mutex);
        impl->playing = false;
      }
      impl->publish(empty);
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
  m->push([impl = m.get(), project] { impl->edit([&](Engine& engine) { engine.update(project); }); });
}

void EngineThread::addCells(const Body& body, std::vector<std::array<int, 3>> cells, int palette,
                            std::function<void(std::vector<uint32_t>)> done) {
  m->push([impl = m.get(), body, cells = std::move(cells), palette, done = std::move(done)] {
    impl->edit([&](Engine& engine) {
      std::vector<uint32_t> ids = engine.addCells(body, cells, palette);
      if (done) done(std::move(ids));
    });
  });
}

void EngineThread::removeParticles(std::vector<uint32_t> ids) {
  m->push([impl = m.get(), ids = std::move(ids)] { impl->edit([&](Engine& engine) { engine.removeParticles(ids); }); });
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

double EngineThread::realTimeFactor() const {
  const std::lock_guard lock(m->mutex);
  return m->playing ? m->realTime : 0;
}

}  // namespace ps
