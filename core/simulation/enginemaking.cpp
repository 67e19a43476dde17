// SPDX-License-Identifier: Apache-2.0
// How an engine's thread makes scenes: watched from outside, and given up when somebody asks for it.
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/plugin_host/registry.h"
#include "core/scene/pose.h"
#include "core/simulation/enginethreadimpl.h"
#include "core/simulation/failure.h"
#include "core/simulation/keptrun.h"
#include "core/simulation/sceneneed.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <utility>

namespace ps {

void EngineThread::Impl::make(const std::function<void()>& makeScene) {
  const auto progress = std::make_shared<Progress>();
  {
    const std::lock_guard lock(mutex);
    making = progress;
    if (stopping.stop_requested() || queue.opens()) progress->cancel();
  }
  if (published) published();
  const ProgressScope scope(progress.get());
  const auto done = [this] {
    const std::lock_guard lock(mutex);
    making = nullptr;
  };
  try {
    advance(0);
    makeScene();
  } catch (...) {
    done();
    throw;
  }
  done();
}

/// Why there is none.
void EngineThread::Impl::noScene(const EngineEvent& failure) {
  engine.reset();
  halt();
  auto empty = std::make_shared<Snapshot>();
  empty->revision = nextRevision();
  publish(std::move(empty));
  fail(failure);
}

/// A reset for which the scene before has to make room.
void EngineThread::Impl::remake(const Reset& start) {
  Project project = engine->document();
  project.state = nullptr;
  engine.reset();
  try {
    make([&] { engine = std::make_unique<Engine>(project, plugins); });
  } catch (...) {
    noScene(failureAtHand(EngineEvent::Kind::NotOpened));
    return;
  }
  recordRun();
  for (const NameMatter& named : start.named) change(named);
  publishEdits();
}

void EngineThread::Impl::recordRun() {
  record.begin(engine->revision());
  record.keepState(*engine);
}

void EngineThread::Impl::recordEdit(RecordedEdit edit) {
  if (!engine) return;
  if (engine->revision() != record.revision())
    recordRun();
  else
    record.add({engine->solver().frame(), std::move(edit)});
}

/// What goes wrong leaves the run as it is, unless the memory does not hold both.
void EngineThread::Impl::goBack(const GoBack& to) {
  if (!engine) return;
  record.settle();
  const uint64_t before = record.present();
  if (to.run && !record.exchange(to.run)) return;
  const uint64_t frame = to.run ? record.extent().last : to.frame;
  const bool edits = to.run || record.documentEditedAfter(frame);
  const Project project = engine->document();
  std::unique_ptr<Engine> past;
  try {
    if (needOf(project, &plugins).bytes > roomToGrow(memoryNow())) engine.reset();
    make([&] {
      const std::optional<RestorePoint> point = record.restorePoint(frame);
      if (!point) throw InputError("the record has no state from which frame " + std::to_string(frame) + " follows");
      past = replayed(*point, plugins);
    });
  } catch (...) {
    if (to.run) record.exchange(before);
    if (engine)
      fail(failureAtHand(EngineEvent::Kind::Refused));
    else
      noScene(failureAtHand(EngineEvent::Kind::NotOpened));
    return;
  }
  engine = std::move(past);
  record.cutAfter(frame, engine->revision());
  standAt(project, edits, to.run != 0, to.play);
}

void EngineThread::Impl::adopt(const Adoption& recording) {
  if (!engine) return;
  const Project project = engine->document();
  const KeptRun& run = recording.content->present;
  std::unique_ptr<Engine> past;
  try {
    if (needOf(project, &plugins).bytes > roomToGrow(memoryNow())) engine.reset();
    make([&] {
      const std::optional<RestorePoint> point =
          run.frames.empty() ? std::nullopt : run.restorePoint(run.frames.rbegin()->first);
      if (!point) throw InputError("it has no state from which its last frame follows");
      past = replayed(*point, plugins);
    });
  } catch (...) {
    EngineEvent failure = failureAtHand(EngineEvent::Kind::Refused);
    failure.message = "the recording is not opened: " + failure.message;
    if (engine)
      fail(failure);
    else
      noScene(failure);
    return;
  }
  engine = std::move(past);
  record.adopt(*recording.content, engine->revision());
  standAt(project, !recording.same, true, false);
  if (recording.adopted) recording.adopted();
}

void EngineThread::Impl::standAt(const Project& project, bool edits, bool wholeHistory, bool play) {
  if (shown) engine->apply(*shown);
  for (const MatterKey key : engine->hands())
    change(TouchMatter{{}, 1, {}, {}, key});  // whose hand it was is not there
  engine->apply(SetProbes{project.probes});   // what is measured goes by the document, in which nothing goes back
  if (edits) {
    // Bodies stand where the document has them, and their matter comes along.
    const std::vector<Body> then = engine->document().bodies;
    for (const Body& body : project.bodies) {
      const auto old = std::find_if(then.begin(), then.end(), [&](const Body& b) { return b.id == body.id; });
      const auto move = old == then.end() ? std::nullopt : moveBetween(*old, body);
      if (move) change(MoveBody{std::make_shared<const Body>(body), *move});
    }
    change(UpdateProject{std::make_shared<const Project>(project)});
  }
  record.keepState(*engine);
  const SnapshotPtr snapshot = engine->snapshot();
  const std::vector<FrameStats> kept = wholeHistory ? record.stats() : std::vector<FrameStats>{};
  {
    const std::lock_guard lock(mutex);
    if (wholeHistory) history.clear();
    for (const FrameStats& stats : kept) history.add(stats);
    history.cutAfter(snapshot->stats.frame);
    newest = snapshot;
    playing = play;
    due = measured = std::chrono::steady_clock::now();
    measuredTime = snapshot->stats.time;
  }
  publish(snapshot);
}

void EngineThread::Impl::open(const Opening& opening) {
  engine.reset();  // two may be more than the memory holds
  try {
    make([&] { engine = std::make_unique<Engine>(*opening.project, plugins); });
  } catch (...) {
    noScene(failureAtHand(EngineEvent::Kind::NotOpened));
    return;
  }
  shown = std::nullopt;
  recordRun();
  {
    const std::lock_guard lock(mutex);
    newest = previous = nullptr;
    playing = opening.play && engine->solver().frame() == 0;
    due = measured = std::chrono::steady_clock::now();
    measuredTime = 0;
  }
  publishEdits();
  for (const std::string& remark : engine->remarks()) notify({0, EngineEvent::Kind::Remark, 0, remark});
  if (!engine->remarks().empty() && published) published();
}

void EngineThread::open(const Project& project, bool play) {
  {
    const std::lock_guard lock(m->mutex);
    if (m->making) m->making->cancel();
    m->queue.push(Opening{std::make_shared<const Project>(project), play});
  }
  m->wake.notify_one();
}

void EngineThread::continueFrom(uint64_t frame, bool play) {
  pause();
  m->push(GoBack{frame, 0, play});
}

void EngineThread::goOnWith(uint64_t run) {
  pause();
  m->push(GoBack{0, run, false});
}

void EngineThread::keepState() {
  m->push(Question([impl = m.get()](const Engine& engine) { impl->record.keepState(engine); }));
}

void EngineThread::adopt(std::shared_ptr<const RunContent> content, bool same, std::function<void()> adopted) {
  pause();
  m->push(Adoption{std::move(content), same, std::move(adopted)});
}

void EngineThread::forgetRun(uint64_t run) { m->record.forgetRun(run); }
void EngineThread::renameRun(uint64_t run, const std::string& name) { m->record.rename(run, name); }

const RunRecord& EngineThread::recording() const { return m->record; }
void EngineThread::forgetRecordedOnDisk() { m->record.forgetDisk(); }
void EngineThread::setRecordBudget(RecordBudget budget) { m->record.setBudget(std::move(budget)); }

std::optional<Progress::State> EngineThread::making() const {
  const std::lock_guard lock(m->mutex);
  return m->making ? std::optional(m->making->state()) : std::nullopt;
}

void EngineThread::cancelMaking() {
  const std::lock_guard lock(m->mutex);
  if (m->making) m->making->cancel();
}

}  // namespace ps
