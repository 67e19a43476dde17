// SPDX-License-Identifier: Apache-2.0
#include "ui/session/recordedview.h"

#include "core/simulation/enginethread.h"
#include "ui/document/document.h"
#include "ui/session/messagelog.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"
#include "ui/session/worker.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace ps {
namespace {
constexpr int kClockInterval = 16;  // ms
}  // namespace

RecordedView::RecordedView(Session& session) : m_session(session) {
  m_clock.setTimerType(Qt::PreciseTimer);
  m_clock.setInterval(kClockInterval);
  connect(&m_clock, &QTimer::timeout, this, &RecordedView::advance);
  connect(&session, &Session::snapshotArrived, this, &RecordedView::followGhost);
  connect(this, &RecordedView::comparedChanged, this, &RecordedView::followGhost);
}

const RunRecord* RecordedView::record() const {
  return m_session.engine() ? &m_session.engine()->recording() : nullptr;
}

RunRecord::Extent RecordedView::extent() const { return record() ? record()->extent() : RunRecord::Extent{}; }

void RecordedView::showAt(double seconds) {
  if (!record()) return;
  if (const auto frame = record()->frameAt(seconds)) want(*frame);
}

void RecordedView::step(int frames) {
  const SnapshotPtr newest = m_session.newest();
  if (!record() || !newest) return;
  const uint64_t at = m_wanted ? *m_wanted : newest->stats.frame;
  if (const auto frame = record()->neighbour(at, frames)) {
    want(*frame);
  } else if (frames > 0) {
    showNewest();
  } else if (const RunRecord::Extent kept = extent(); kept.frames > 0 && kept.last < at) {
    want(kept.last);  // the newest is not packed yet
  }
}

void RecordedView::stepToMark(bool forward) {
  const RunRecord::Extent kept = extent();
  if (kept.frames == 0) return;
  std::vector<double> marks{kept.from, kept.to};
  for (const Track& track : m_session.document().project().tracks) {
    for (const TrackKey& key : track.keys) {
      if (key.time > kept.from && key.time < kept.to) marks.push_back(key.time);
    }
  }
  for (const Marker& marker : m_session.document().project().markers) {
    if (marker.time > kept.from && marker.time < kept.to) marks.push_back(marker.time);
  }
  std::sort(marks.begin(), marks.end());
  const double now = m_session.now(), frame = 2 * m_session.document().keySlack();
  if (forward) {
    const auto next = std::upper_bound(marks.begin(), marks.end(), now + frame);
    if (next != marks.end()) showAt(*next);
  } else {
    const auto next = std::lower_bound(marks.begin(), marks.end(), now - frame);
    if (next != marks.begin()) showAt(*std::prev(next));
  }
}

void RecordedView::want(uint64_t frame) {
  if (m_session.playing()) m_session.pause();
  const SnapshotPtr newest = m_session.newest();
  if (newest && frame >= newest->stats.frame) {
    showNewest();
    return;
  }
  m_wanted = frame;
  unpack();
}

void RecordedView::unpack() {
  if (m_busy || !m_wanted) return;
  m_busy = true;
  m_session.worker().run([this, frame = *m_wanted, from = record()] {
    SnapshotPtr snapshot;
    try {
      snapshot = from->frame(frame);
    } catch (const std::exception&) {
      snapshot = nullptr;  // as one that is not kept any more
    }
    QMetaObject::invokeMethod(this, [this, frame, snapshot] {
      m_busy = false;
      if (!m_wanted) return;
      if (snapshot && snapshot->revision == m_revision) setShown(snapshot);
      if (*m_wanted != frame)
        unpack();
      else if (!snapshot)
        m_wanted = m_shown ? std::optional(m_shown->stats.frame) : std::nullopt;
    });
  });
}

void RecordedView::setLoop(bool on) {
  if (std::exchange(m_loop, on) != on) Q_EMIT paceChanged();
}

void RecordedView::setSpeed(double speed) {
  if (std::exchange(m_speed, speed) != speed) Q_EMIT paceChanged();
}

bool RecordedView::isMeant() const { return (isActive() || m_loop) && extent().frames > 1; }

void RecordedView::play() {
  m_at = isActive() ? m_session.now() : extent().from;
  m_since.start();
  m_clock.start();
  Q_EMIT playingChanged();
}

void RecordedView::pause() {
  if (!m_clock.isActive()) return;
  m_clock.stop();
  Q_EMIT playingChanged();
}

void RecordedView::advance() {
  m_at += static_cast<double>(m_since.restart()) / 1000 * m_speed;
  const RunRecord::Extent kept = extent();
  if (m_at > kept.to && m_loop) m_at = kept.from;
  if (kept.frames > 0 && m_at <= kept.to) {
    m_wanted = record()->frameAt(m_at);
    unpack();
    return;
  }
  showNewest();
  const SnapshotPtr newest = m_session.newest();
  const Document& document = m_session.document();
  if (newest && newest->stats.time < document.project().duration - document.keySlack()) m_session.play();
}

void RecordedView::showNewest() {
  pause();
  m_wanted = std::nullopt;
  setShown(nullptr);
}

void RecordedView::setShown(SnapshotPtr snapshot) {
  if (snapshot == m_shown) return;
  m_shown = std::move(snapshot);
  Q_EMIT changed();
}

void RecordedView::continueFromHere() {
  const SnapshotPtr newest = m_session.newest();
  if (!m_shown || !newest || m_session.engine()->making()) return;
  m_continuing = QStringLiteral("The run goes on from %1. As it was, up to %2, it is kept as run %3.")
                     .arg(clockText(m_shown->stats.time), clockText(newest->stats.time))
                     .arg(record()->present());
  m_left = record()->present();
  m_session.engine()->continueFrom(m_shown->stats.frame, true);
}

std::vector<RunRecord::EarlierRun> RecordedView::earlier() const {
  return record() ? record()->earlier() : std::vector<RunRecord::EarlierRun>{};
}

void RecordedView::goOnWith(uint64_t run) {
  if (!record() || m_session.engine()->making()) return;
  m_session.pause();
  m_continuing = QStringLiteral("Run %1 goes on from its end; the one before is kept as run %2.")
                     .arg(run)
                     .arg(record()->present());
  m_left = record()->present();
  m_session.engine()->goOnWith(run);
}

void RecordedView::forgetRun(uint64_t run) {
  if (!record()) return;
  m_session.engine()->forgetRun(run);
  if (m_compared == run) compare(std::nullopt);
  Q_EMIT runsChanged();
}

void RecordedView::forgetDisk() {
  if (!record()) return;
  m_session.engine()->forgetRecordedOnDisk();
  Q_EMIT runsChanged();
}

void RecordedView::renameRun(uint64_t run, const QString& name) {
  if (!record()) return;
  m_session.engine()->renameRun(run, name.trimmed().toStdString());
  Q_EMIT runsChanged();
}

QString RecordedView::runName(uint64_t run) const {
  for (const RunRecord::EarlierRun& one : earlier()) {
    if (one.number == run && !one.name.empty()) return QString::fromStdString(one.name);
  }
  return QStringLiteral("Run %1").arg(run);
}

void RecordedView::compare(std::optional<uint64_t> run) {
  if (!record() || run == m_compared) return;
  m_compared = run;
  m_comparedStats.clear();
  Q_EMIT comparedChanged();
  if (!run) return;
  m_session.worker().run([this, number = *run, from = record()] {
    auto stats = std::make_shared<std::vector<FrameStats>>(from->stats(number));
    QMetaObject::invokeMethod(this, [this, number, stats] {
      if (m_compared != number) return;
      m_comparedStats = std::move(*stats);
      Q_EMIT comparedChanged();
    });
  });
}

QString RecordedView::setGhost(bool on) {
  const std::vector<RunRecord::EarlierRun> runs = earlier();
  if (on && runs.empty())
    return QStringLiteral("There is no earlier run. Show a recorded frame and continue from there to have one.");
  m_hasGhost = on;
  if (on && !m_compared) compare(runs.back().number);
  followGhost();
  Q_EMIT runsChanged();
  return {};
}

/// A worker unpacks; what is asked for meanwhile is asked for again when that has come.
void RecordedView::followGhost() {
  if (!m_hasGhost || !m_compared || !record()) {
    setGhostShown(nullptr);
    return;
  }
  const std::pair wanted(*m_compared, m_session.now());
  if (m_ghostBusy || (m_ghost && m_ghostAt == wanted)) return;
  m_ghostBusy = true;
  m_session.worker().run([this, wanted, from = record()] {
    SnapshotPtr ghost;
    try {
      ghost = from->earlierFrame(wanted.first, wanted.second);
    } catch (const std::exception&) {
      ghost = nullptr;  // as one that is not kept any more
    }
    QMetaObject::invokeMethod(this, [this, wanted, ghost] {
      m_ghostBusy = false;
      m_ghostAt = wanted;
      if (!m_hasGhost || m_compared != wanted.first) {
        followGhost();
        return;
      }
      setGhostShown(ghost);
      if (m_session.now() != wanted.second) followGhost();
    });
  });
}

void RecordedView::setGhostShown(SnapshotPtr ghost) {
  if (ghost == m_ghost) return;
  m_ghost = std::move(ghost);
  Q_EMIT ghostChanged();
}

void RecordedView::follow(const SnapshotPtr& newest) {
  if (!newest || newest->revision == m_revision) return;
  m_revision = newest->revision;
  const QString continuing = std::exchange(m_continuing, QString());
  showNewest();
  const std::vector<RunRecord::EarlierRun> runs = earlier();
  const auto isKept = [&](uint64_t number) {
    return std::any_of(runs.begin(), runs.end(),
                       [&](const RunRecord::EarlierRun& run) { return run.number == number; });
  };
  if (!continuing.isEmpty() && isKept(m_left))
    compare(m_left);
  else if (m_compared && !isKept(*m_compared))
    compare(std::nullopt);
  if (!continuing.isEmpty()) m_session.log().add(MessageLevel::Info, QStringLiteral("Timeline"), continuing);
}

}  // namespace ps
