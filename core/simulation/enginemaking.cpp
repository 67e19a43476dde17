// SPDX-License-Identifier: Apache-2.0
// How an engine's thread makes scenes: watched from outside, and given up when somebody asks for it.
#include "core/base/memory.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/enginethreadimpl.h"
#include "core/simulation/failure.h"
#include "core/simulation/sceneneed.h"
#include "core/solver/solver.h"

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
  for (const NameMatter& named : start.named) engine->apply(named);
  publishEdits();
}

void EngineThread::Impl::open(const Opening& opening) {
  engine.reset();  // two may be more than the memory holds
  try {
    make([&] { engine = std::make_unique<Engine>(*opening.project, plugins); });
  } catch (...) {
    noScene(failureAtHand(EngineEvent::Kind::NotOpened));
    return;
  }
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

std::optional<Progress::State> EngineThread::making() const {
  const std::lock_guard lock(m->mutex);
  return m->making ? std::optional(m->making->state()) : std::nullopt;
}

void EngineThread::cancelMaking() {
  const std::lock_guard lock(m->mutex);
  if (m->making) m->making->cancel();
}

}  // namespace ps
