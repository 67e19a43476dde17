// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/runrecord.h"

#include "core/base/error.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/simulation/engine.h"
#include "core/simulation/namedmatter.h"
#include "core/simulation/runrecordimpl.h"
#include "core/solver/solver.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {

constexpr double kStateInterval = 2;      // s of the run
constexpr double kStateShare = 1.0 / 50;  // of the time, at most
constexpr size_t kMostWaiting = 4;        // frames
constexpr int kNiceness = 10;             // the solver's threads come first

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

bool changesDocument(const RecordedEdit& edit) {
  const auto* command = std::get_if<Command>(&edit);
  return !command || std::holds_alternative<SetParameter>(*command) || std::holds_alternative<SetTracks>(*command) ||
         std::holds_alternative<MoveBody>(*command) || std::holds_alternative<UpdateProject>(*command);
}

RunRecord::RunRecord(RecordBudget budget) : m(std::make_unique<Impl>(std::move(budget))) {
  m->thread = std::jthread([impl = m.get()](const std::stop_token& stop) { impl->loop(stop); });
}

RunRecord::~RunRecord() {
  m->thread.request_stop();
  m->thread.join();
}

size_t RunRecord::usualBudget() {
  constexpr double kLeast = 64.0 * (1 << 20), kMost = 16.0 * (1 << 30);
  const double quarter = memoryNow().free / 4;
  return static_cast<size_t>(std::clamp(quarter, kLeast, kMost));
}

void RunRecord::setBudget(RecordBudget budget) {
  {
    const std::lock_guard lock(m->mutex);
    m->budget = std::move(budget);
    m->diskFails = false;
    m->resized = true;
  }
  m->wake.notify_one();
}

void RunRecord::begin(uint64_t revision) {
  {
    const std::lock_guard lock(m->mutex);
    m->clear();
    m->revision = revision;
  }
  m->wake.notify_one();
}

uint64_t RunRecord::revision() const {
  const std::lock_guard lock(m->mutex);
  return m->revision;
}

uint64_t RunRecord::begun() const {
  const std::lock_guard lock(m->mutex);
  return m->begun;
}

/// Where too many wait, the last of them is left out: what comes last is always kept.
void RunRecord::add(SnapshotPtr snapshot) {
  {
    const std::lock_guard lock(m->mutex);
    if (snapshot->revision != m->revision || !snapshot->bodyIds) return;
    std::deque<SnapshotPtr>& waiting = m->waiting;
    const bool again = !waiting.empty() && waiting.back()->stats.frame == snapshot->stats.frame;
    if (!again && waiting.size() == kMostWaiting) ++m->leftOut;
    if (again || waiting.size() == kMostWaiting) waiting.pop_back();
    waiting.push_back(std::move(snapshot));
  }
  m->wake.notify_one();
}

void RunRecord::add(FrameEdit edit) {
  const std::lock_guard lock(m->mutex);
  m->addEdit(std::move(edit));
}

bool RunRecord::wantsState(double time) const {
  const std::lock_guard lock(m->mutex);
  if (m->waitingState) return false;
  if (m->states.empty() && m->stateAt == Impl::Clock::time_point{}) return true;
  return time >= m->stateTime + kStateInterval && secondsSince(m->stateAt) * kStateShare >= m->stateSeconds;
}

void RunRecord::keepState(const Engine& engine) {
  const auto start = Impl::Clock::now();
  Impl::RawState raw;
  saveTo(raw.stream, engine);
  raw.state.frame = engine.solver().frame();
  raw.state.names = engine.names();
  const bool known = m->document && m->documentEdits == m->edits.size();  // who runs alone adds edits
  if (!known) m->document = std::make_shared<const Project>(engine.document());
  raw.state.document = m->document;
  {
    const std::lock_guard lock(m->mutex);
    m->documentEdits = raw.state.edits = m->edits.size();
    m->waitingState = std::move(raw);
    m->stateTime = engine.solver().time();
    m->stateAt = Impl::Clock::now();
    m->stateSeconds = secondsSince(start);
  }
  m->wake.notify_one();
}

void RunRecord::cutAfter(uint64_t frame, uint64_t revision) {
  const std::lock_guard lock(m->mutex);
  m->keepAsEarlier(frame);
  m->forgetAfter(frame);
  m->revision = revision;
}

bool RunRecord::exchange(uint64_t number) {
  const std::lock_guard lock(m->mutex);
  const auto chosen =
      std::find_if(m->earlier.begin(), m->earlier.end(), [&](const KeptRun& run) { return run.number == number; });
  if (chosen == m->earlier.end()) return false;
  const double apart = chosen->apart;
  std::swap(static_cast<KeptRun&>(*m), *chosen);
  for (KeptRun& run : m->earlier) run.apart = std::min(run.apart, apart);
  chosen->apart = apart;
  m->startAfresh();
  return true;
}

void RunRecord::adopt(RunContent content, uint64_t revision) {
  {
    const std::lock_guard lock(m->mutex);
    m->clear();
    std::erase_if(content.earlier, [](const KeptRun& run) { return run.frames.empty(); });
    const auto here = [](KeptRun& run) { run.adopted = run.frames.empty() ? 0 : run.frames.rbegin()->first + 1; };
    here(content.present);
    std::for_each(content.earlier.begin(), content.earlier.end(), here);
    static_cast<KeptRun&>(*m) = std::move(content.present);
    m->earlier = std::move(content.earlier);
    m->runs = std::max(content.runs, m->number);
    m->revision = revision;
    m->stateTime = m->frames.empty() ? 0 : m->frames.rbegin()->second->stats.time;
    m->stateAt = Impl::Clock::now();
  }
  m->wake.notify_one();
}

bool RunRecord::documentEditedAfter(uint64_t frame) const {
  const std::lock_guard lock(m->mutex);
  return std::any_of(m->edits.rbegin(), m->edits.rend(),
                     [frame](const FrameEdit& edit) { return edit.frame > frame && changesDocument(edit.edit); });
}

/// What is packed now is of another run.
void RunRecord::Impl::startAfresh() {
  ++generation;
  waiting.clear();
  waitingState.reset();
  document = nullptr;
  sweep = sweepEnd = onDisk = 0;
}

void RunRecord::Impl::clear() {
  startAfresh();
  ++begun;
  while (!earlier.empty()) drop(earlier.begin());
  dropped.push_back(std::exchange(static_cast<KeptRun&>(*this), {}));
  runs = stride = 1;
  documentEdits = leftOut = 0;
  stateAt = {};
  packSeconds = stateSeconds = 0;
}

void RunRecord::Impl::keepAsEarlier(uint64_t frame) {
  const auto after = frames.upper_bound(frame);
  if (after == frames.end()) return;
  const double time = (after == frames.begin() ? after : std::prev(after))->second->stats.time;
  for (KeptRun& run : earlier) run.apart = std::min(run.apart, time);
  earlier.push_back(*this);
  earlier.back().apart = time;
  number = ++runs;
  name.clear();
}

void RunRecord::Impl::forgetAfter(uint64_t frame) {
  startAfresh();
  while (!frames.empty() && frames.rbegin()->first > frame) eraseFrame(std::prev(frames.end()));
  adopted = std::min(adopted, frame + 1);
  std::erase_if(states, [&](const State& state) { return state.frame > frame; });
  eraseEditsAfter(frame);
}

void RunRecord::Impl::loop(const std::stop_token& stop) {
  setpriority(PRIO_PROCESS, 0, kNiceness);  // of this thread alone, as Linux has it
  FramePacker packer(counted);
  std::unique_lock lock(mutex);
  uint64_t packing = generation;
  while (wake.wait(lock, stop, [this] { return !idle(); })) {
    busy = true;
    const uint64_t of = generation;
    if (std::exchange(packing, of) != of) packer = FramePacker(counted);
    std::optional<RawState> state = std::exchange(waitingState, std::nullopt);
    SnapshotPtr snapshot;
    if (!state && !waiting.empty()) {
      snapshot = std::move(waiting.front());
      waiting.pop_front();
    }
    std::vector<KeptRun> gone = std::exchange(dropped, {});
    resized = false;
    const bool forgets = std::exchange(forgetsDisk, false);
    lock.unlock();
    gone.clear();
    if (forgets) emptyDisk();
    try {
      if (state) packState(std::move(*state), of);
      if (snapshot) packFrame(snapshot, of, packer);
    } catch (const std::exception& problem) {
      log(LogLevel::Warning, std::string("A frame is not recorded: ") + problem.what());
    }
    makeRoom();
    snapshot = nullptr;
    lock.lock();
    busy = false;
    ++turns;
    done.notify_all();
  }
}

void RunRecord::Impl::packState(RawState raw, uint64_t of) {
  raw.state.stream = packedState(raw.stream.bytes(), counted);
  const std::lock_guard lock(mutex);
  if (of != generation) return;
  std::erase_if(states, [&](const State& state) { return state.frame == raw.state.frame; });
  states.push_back(std::move(raw.state));
}

void RunRecord::Impl::packFrame(const SnapshotPtr& snapshot, uint64_t of, FramePacker& packer) {
  const auto start = Clock::now();
  FramePacker::Packed packed = packer.pack(*snapshot);
  const std::lock_guard lock(mutex);
  packSeconds += secondsSince(start);
  if (of != generation) return;
  for (PackedFrame& frame : packed.anew) {
    const uint64_t again = frame.stats.frame;
    if (!frames.contains(again)) continue;  // it was thinned meanwhile
    onDisk = std::min(onDisk, again);
    addFrame(std::make_shared<const PackedFrame>(std::move(frame)));
  }
  addFrame(std::make_shared<const PackedFrame>(std::move(packed.frame)));
}

void RunRecord::settle() const {
  std::unique_lock lock(m->mutex);
  const uint64_t last = m->turns + kMostWaiting + 2;  // the frames, a state, and what is being packed
  m->done.wait(lock, [&] { return m->idle() || m->turns >= last; });
}

}  // namespace ps
