// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/enginethread.h"

#include "core/base/memory.h"
#include "core/plugin_host/crashwatch.h"
#include "core/simulation/enginethreadimpl.h"
#include "core/simulation/failure.h"
#include "core/simulation/sceneneed.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <utility>

// Why a thread with a queue: the interface must never wait for a step. Commands are values that are applied between
// frames, in order; what the interface reads (snapshot, history, clock) is copied out under a mutex that is held for
// microseconds. Why the queue merges: a dragged slider gives hundreds of values a second, of which a frame needs the
// last. Why edits have a budget: they and the frames take turns, so that neither keeps the other from going on.
namespace ps {
namespace {

using Clock = std::chrono::steady_clock;

/// After these somebody must look before it goes on.
constexpr StepFlags kPausing = kTakenBack | static_cast<StepFlags>(StepFlag::PluginFault);
/// Frames without a flag after which what was reported is over, and would be reported again.
constexpr int kQuiet = 60;
constexpr size_t kMostEvents = 256;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

void EngineThread::Impl::run(const std::stop_token& stop) {
  stopping = stop;
  while (!stop.stop_requested()) {
    {
      std::unique_lock lock(mutex);
      if (playing) {
        const auto until = due;  // wait_until reads it without the lock, and play() writes due
        wake.wait_until(lock, stop, until, [&] { return !queue.empty(); });
      } else {
        wake.wait(lock, stop, [&] { return !queue.empty() || playing; });
      }
    }
    if (stop.stop_requested()) return;
    try {
      turn();
    } catch (...) {
      const EngineEvent failure = failureAtHand(EngineEvent::Kind::Stopped);
      halt();
      fail(failure);
    }
  }
}

/// Edits for as long as a frame lasts at most, then the frame that is due.
void EngineThread::Impl::turn() {
  workOff();
  if (frameIsDue()) {
    step();
    pace();
  } else if (edited && !frameIsDue(snapshotSeconds)) {  // else the frame's own snapshot shows them, and comes in time
    publishEdits();
  }
}

bool EngineThread::Impl::frameIsDue(double ahead) {
  const auto soon = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(ahead));
  const std::lock_guard lock(mutex);
  return playing && Clock::now() + soon >= due;
}

void EngineThread::Impl::workOff() {
  const auto start = Clock::now();
  for (;;) {
    std::optional<QueueEntry> entry;
    {
      const std::lock_guard lock(mutex);
      entry = queue.pop();
    }
    if (!entry) return;
    if (const auto* batch = std::get_if<ParameterBatch>(&*entry)) {
      editAll(*batch);
    } else if (const auto* command = std::get_if<Command>(&*entry);
               command &&
               (std::holds_alternative<ShowFields>(*command) || std::holds_alternative<SetProbes>(*command))) {
      look(*command);
    } else if (command) {
      change(*command);
    } else if (const auto* opening = std::get_if<Opening>(&*entry)) {
      open(*opening);
    } else if (const auto* question = std::get_if<Question>(&*entry)) {
      answer(*question);
    } else if (const auto* back = std::get_if<GoBack>(&*entry)) {
      goBack(*back);
    } else if (const auto* recording = std::get_if<Adoption>(&*entry)) {
      adopt(*recording);
    } else {
      step();
    }
    const double frame = engine ? numberOf(engine->project().solver.parameters, solverParameters(), "dt") : 0;
    if (stopping.stop_requested() || (frameIsDue() && secondsSince(start) >= frame)) return;
  }
}

void EngineThread::Impl::step() {
  if (!engine) return;
  const StepReport report = engine->step();
  if (report.flags & kPausing) halt();
  tellOf(report);
  const auto start = Clock::now();
  SnapshotPtr snapshot = engine->snapshot();
  snapshotSeconds = secondsSince(start);
  // Play stops at the end of the scene, once: played from there, it goes on.
  const Project& project = engine->project();
  const double last = project.duration - numberOf(project.solver.parameters, solverParameters(), "dt") / 2;
  const bool ends = newest && newest->stats.time < last && snapshot->stats.time >= last;
  publish(std::move(snapshot), ends);
  if (record.wantsState(engine->solver().time())) record.keepState(*engine);
}

/// At its speed when the solver can keep up, as fast as it goes when it cannot.
void EngineThread::Impl::pace() {
  const auto now = Clock::now();
  const double dt = engine ? numberOf(engine->project().solver.parameters, solverParameters(), "dt") : 1.0 / 60;
  const std::lock_guard lock(mutex);
  due += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(dt / speed));
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

void EngineThread::Impl::notify(EngineEvent event) {
  const std::lock_guard lock(mutex);
  if (events.size() == kMostEvents) events.pop_front();
  event.number = eventCount++;
  events.push_back(std::move(event));
}

/// Nobody can end that call. Whoever ends the program instead finds it without the plugin at the next start.
void EngineThread::Impl::isLate(const std::string& id) {
  putInQuarantine(id);
  fail({0, EngineEvent::Kind::Late, 0, id});
}

void EngineThread::Impl::isBack(const std::string& id) {
  takeFromQuarantine(id);
  if (standing().kind == EngineEvent::Kind::Late) fail({0, EngineEvent::Kind::Settled, 0, {}});
}

EngineEvent EngineThread::Impl::standing() {
  const std::lock_guard lock(mutex);
  return events.empty() ? EngineEvent{0, EngineEvent::Kind::Settled, 0, {}} : events.back();
}

void EngineThread::Impl::settle() {
  reported = 0;
  quiet = 0;
  if (standing().kind != EngineEvent::Kind::Settled) notify({0, EngineEvent::Kind::Settled, 0, {}});
}

void EngineThread::Impl::follow(uint64_t revision) {
  if (std::exchange(reportedOf, revision) != revision) settle();
}

/// A flag may be raised in every frame, or in every third: after the first time it is reported after a quiet second.
void EngineThread::Impl::tellOf(const StepReport& report) {
  quiet = report.flags ? 0 : std::min(quiet + 1, kQuiet + 1);
  if (report.flags & (~reported | kPausing)) notify({0, EngineEvent::Kind::Step, report.flags, report.message});
  reported |= report.flags;
  if (quiet != kQuiet) return;
  reported = 0;
  const EngineEvent::Kind kind = standing().kind;
  if (kind == EngineEvent::Kind::Step || kind == EngineEvent::Kind::Stopped) settle();
}

void EngineThread::Impl::publish(SnapshotPtr snapshot, bool ends) {
  edited = false;
  record.add(snapshot);
  const bool fresh = !newest || newest->revision != snapshot->revision;
  follow(snapshot->revision);
  {
    const std::lock_guard lock(mutex);
    if (fresh) {
      history.clear();
      previous = nullptr;
    } else {
      previous = newest;
    }
    history.add(snapshot->stats);
    newest = std::move(snapshot);
    if (ends) playing = false;
  }
  if (published) published();
}

void EngineThread::Impl::fail(EngineEvent event) {
  if (event.kind == EngineEvent::Kind::Cancelled) {
    const std::lock_guard lock(mutex);
    if (queue.opens()) return;  // for another one, which says what became of it
  }
  if (event.kind == EngineEvent::Kind::Refused && event.flags) halt();
  notify(std::move(event));
  if (published) published();
}

template <class Action>
std::optional<EngineEvent> EngineThread::Impl::edit(Action action, bool mends) {
  if (!engine) return std::nullopt;
  const auto start = Clock::now();
  const uint64_t tables = engine->bakedTables();
  try {
    action();
  } catch (...) {
    return failureAtHand(EngineEvent::Kind::Refused);
  }
  edited = true;
  {
    const std::lock_guard lock(mutex);
    ++cost.applied;
    cost.baked += engine->bakedTables() - tables;
    cost.seconds += secondsSince(start);
  }
  follow(engine->revision());  // before edits that wait behind a reset are refused
  // An edit that works mends a refusal and what made the scene pause; flags of running steps end by themselves.
  const EngineEvent last = standing();
  if (mends && !(last.flags & ~kPausing)) settle();
  return std::nullopt;
}

/// A scene that is made again stands beside the one before until it is whole, where the memory holds both. What strokes
/// have made of it is named by edits of the new run: from a file nothing else says what its first state knows of them.
void EngineThread::Impl::change(const Command& command) {
  const auto* start = std::get_if<Reset>(&command);
  if (engine && start && needOf(engine->document(), &plugins).bytes > roomToGrow(memoryNow())) {
    remake(*start);
    return;
  }
  const bool makes = start || std::holds_alternative<ReturnToState>(command);
  const bool mends = !std::holds_alternative<ForgetMatter>(command);  // what no undo step asks for any more is no edit
  const auto refusal = edit(
      [&] {
        if (makes)
          make([&] { engine->apply(start ? Command(Reset{}) : command); });
        else
          engine->apply(command);
      },
      mends);
  if (refusal) return fail(*refusal);
  recordEdit(command);
  if (!start) return;
  for (const NameMatter& named : start->named) change(named);
}

/// Those that are refused together may be good alone; each that is not is reported.
void EngineThread::Impl::editAll(const ParameterBatch& batch) {
  const std::optional<EngineEvent> together = edit([&] { engine->setParameters(batch); });
  if (!together) {
    recordEdit(batch);
    return;
  }
  std::vector<EngineEvent> refusals;
  for (const SetParameter& one : batch) {
    std::optional<EngineEvent> refusal = together;
    if (batch.size() > 1) refusal = edit([&] { engine->setParameters({&one, 1}); });
    if (!refusal) {
      recordEdit(ParameterBatch{one});
      continue;
    }
    if (together->flags) refusal->message = together->message;  // a plugin says what is wrong but once
    refusals.push_back(refusalOf(one, engine->document(), *refusal));
  }
  for (const EngineEvent& refusal : refusals) fail(refusal);
}

/// No edit: what was refused stays refused.
void EngineThread::Impl::look(const Command& command) {
  if (!engine) return;
  engine->apply(command);
  if (const auto* fields = std::get_if<ShowFields>(&command)) shown = *fields;
  edited = true;
}

/// Who asks sees what the snapshot shows.
void EngineThread::Impl::answer(const Question& question) {
  if (edited) publishEdits();
  if (!engine) return;
  try {
    question(*engine);
  } catch (...) {
    fail(failureAtHand(EngineEvent::Kind::Refused));
  }
}

void EngineThread::Impl::publishEdits() {
  if (!engine) return;
  publish(engine->snapshot());
}

EngineThread::EngineThread(PluginRegistry& plugins, std::function<void()> published)
    : EngineThread(plugins, std::move(published), RecordBudget{RunRecord::usualBudget()}) {}

EngineThread::EngineThread(PluginRegistry& plugins, std::function<void()> published, RecordBudget budget)
    : m(std::make_unique<Impl>(plugins, std::move(published), std::move(budget))) {
  m->thread = std::jthread([impl = m.get()](const std::stop_token& stop) { impl->run(stop); });
}

EngineThread::~EngineThread() {
  m->thread.request_stop();
  cancelMaking();
  m->thread.join();
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

void EngineThread::setSpeed(double speed) {
  const std::lock_guard lock(m->mutex);
  m->speed = speed;
}

void EngineThread::stepOnce() {
  pause();
  m->push(SingleStep{});
}

void EngineThread::apply(Command command) { m->push(std::move(command), 1); }
void EngineThread::reset() { apply(Reset{}); }
void EngineThread::setParameter(const Address& address, const Value& value) { apply(SetParameter{address, value}); }
void EngineThread::update(const Project& project) { apply(UpdateProject{std::make_shared<const Project>(project)}); }
void EngineThread::ask(std::function<void(const Engine&)> question) { m->push(std::move(question)); }

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

std::vector<FrameStats> EngineThread::history(uint64_t frame, size_t most) const {
  const std::lock_guard lock(m->mutex);
  return m->history.since(frame, most);
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

EditCost EngineThread::editCost() const {
  const std::lock_guard lock(m->mutex);
  return m->cost;
}

}  // namespace ps
