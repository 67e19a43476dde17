// SPDX-License-Identifier: Apache-2.0
#include "ui/session/runwork.h"

#include "core/base/progress.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/keptrun.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"

#include <utility>

namespace ps {
namespace {
constexpr int kClockInterval = 200;  // ms
}  // namespace

struct RunWork::Outcome {
  Result result;
  bool cancelled = false;
  QString problem;
};

RunWork::RunWork(Session& session) : m_session(session) {
  m_clock.setInterval(kClockInterval);
  connect(&m_clock, &QTimer::timeout, this, &RunWork::tell);
}

RunWork::~RunWork() {
  if (m_progress) m_progress->cancel();
}

bool RunWork::cancel() {
  if (!m_progress || m_progress->cancelled()) return false;
  m_progress->cancel();
  tell();
  return true;
}

bool RunWork::isCancelled() const { return m_progress && m_progress->cancelled(); }

int RunWork::percent() const { return m_progress ? static_cast<int>(100 * m_progress->state().done) : -1; }

QString RunWork::stage() const {
  const Progress::State state = m_progress ? m_progress->state() : Progress::State();
  return QString::fromUtf8(state.stage ? state.stage : "Beginning");
}

void RunWork::tell() {
  const Progress::State state = m_progress->state();
  const double seconds = static_cast<double>(m_since.elapsed()) / 1000;
  Q_EMIT working(stage(), state.done, secondsLeft(seconds, state.done));
}

void RunWork::start(Task task) {
  if (isBusy() || !m_session.engine()) return;
  m_progress = std::make_shared<Progress>();
  m_progress->expect(1);
  m_since.start();
  m_clock.start();
  m_worker.run([this, task = std::move(task), record = &m_session.engine()->recording(), progress = m_progress] {
    const ProgressScope scope(progress.get());
    Outcome outcome;
    try {
      record->settle();
      outcome.result = task.act(record->content().present);
    } catch (const Cancelled&) {
      outcome.cancelled = true;
    } catch (const std::exception& error) {
      outcome.problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(this, [this, task, outcome] { finish(task, outcome); });
  });
}

void RunWork::finish(const Task& task, const Outcome& outcome) {
  m_progress.reset();
  m_clock.stop();
  Q_EMIT ended();
  if (!outcome.problem.isEmpty())
    Q_EMIT failed(task.what, outcome.problem);
  else if (outcome.cancelled)
    Q_EMIT cancelled(task.what, task.where);
  else
    Q_EMIT done(task.what, outcome.result.text, outcome.result.level);
}

}  // namespace ps
