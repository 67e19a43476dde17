// SPDX-License-Identifier: Apache-2.0
#include "ui/session/recordingfiles.h"

#include "core/base/log.h"
#include "core/base/progress.h"
#include "core/io/projectio.h"
#include "core/io/recording.h"
#include "core/plugin_host/registry.h"
#include "core/simulation/engine.h"
#include "core/simulation/enginethread.h"
#include "core/simulation/keptrun.h"
#include "core/simulation/packedframe.h"
#include "core/simulation/runrecord.h"
#include "ui/document/document.h"
#include "ui/session/autosave.h"
#include "ui/session/documentfiles.h"
#include "ui/session/session.h"
#include "ui/session/wording.h"

#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QPointer>

#include <chrono>
#include <future>
#include <iterator>
#include <utility>

namespace ps {
namespace {
constexpr int kClockInterval = 200;           // ms
constexpr std::chrono::seconds kPatience(3);  // with an engine that is amid a frame, while a window closes
const QString kNoScene = QStringLiteral("there is no scene that runs");

/// What can be gone on from, and nothing of before.
RunContent endOf(RunContent content) {
  KeptRun& run = content.present;
  content.earlier.clear();
  if (run.states.empty()) return content;
  run.states.erase(run.states.begin(), std::prev(run.states.end()));
  KeptRun::State& state = run.states.front();
  run.edits.erase(run.edits.begin(), run.edits.begin() + static_cast<std::ptrdiff_t>(state.edits));
  state.edits = 0;
  while (!run.frames.empty() && run.frames.begin()->first < state.frame) run.eraseFrame(run.frames.begin());
  return content;
}
}  // namespace

/// What was read, and of what project.
struct RecordingFiles::Read {
  std::shared_ptr<const RunContent> content;
  std::shared_ptr<const Project> project;  ///< that the recording holds
  bool same = false;                       ///< as the one that is open
  bool cancelled = false;
  QString problem, damage;
};

/// Goes with the question, whether the engine answers it or has no scene. It may when these files are gone, but never
/// when the session is.
struct RecordingFiles::Answer {
  Session* session;
  QPointer<RecordingFiles> files;
  std::optional<uint64_t> begun{};  ///< RunRecord::begun() then
  Answer(Session& of, RecordingFiles* asking) : session(&of), files(asking) {}
  Answer(const Answer&) = delete;
  Answer& operator=(const Answer&) = delete;
  ~Answer() {
    QMetaObject::invokeMethod(session, [files = files, begun = begun] {
      if (files) files->onAnswer(begun);
    });
  }
};

RecordingFiles::RecordingFiles(Session& session) : m_session(session) {
  m_clock.setInterval(kClockInterval);
  connect(&m_clock, &QTimer::timeout, this, [this] {
    if (m_progress->cancelled()) return;
    const Progress::State state = m_progress->state();
    m_told = true;
    const double seconds = static_cast<double>(m_since.elapsed()) / 1000;
    Q_EMIT working(QString::fromUtf8(state.stage ? state.stage : "Beginning"), state.done,
                   secondsLeft(seconds, state.done));
  });
  connect(&session.files(), &DocumentFiles::reopened, this,
          [this](const AutosavedSession& left) { m_comesBack = left.look.hasRun; });
  connect(&session.files(), &DocumentFiles::opened, this, &RecordingFiles::onOpened);
}

RecordingFiles::~RecordingFiles() {
  if (m_reading) m_reading->cancel();
  for (Waiting& one : m_waiting) m_worker.run([write = std::move(one.write), begun = one.begun] { write(begun); });
}

void RecordingFiles::onOpened(const QString& project) {
  if (m_reading) m_reading->cancel();
  m_keptIsBack = true;
  const bool comesBack = std::exchange(m_comesBack, false);
  if (comesBack && m_session.autosave()) {
    m_keptIsBack = false;
    read(m_session.autosave()->runPath(), Way::Kept);
  } else {
    attachBeside(project);
  }
}

void RecordingFiles::attachBeside(const QString& project) {
  const QString recording = beside(project);
  if (isRecording(recording.toStdString())) read(recording, Way::Beside);
}

QString RecordingFiles::beside(const QString& project) {
  if (project.isEmpty()) return {};
  const QFileInfo info(project);
  return info.path() + QLatin1Char('/') + info.completeBaseName() + QLatin1String(kRecordingEnding);
}

void RecordingFiles::begin() {
  m_progress = std::make_shared<Progress>();
  ++m_jobs;
  m_since.start();
  m_clock.start();
}

void RecordingFiles::end() {
  if (--m_jobs > 0) return;
  m_clock.stop();
  if (std::exchange(m_told, false)) Q_EMIT ended();
}

void RecordingFiles::cancel() {
  for (const auto& progress : {m_progress, m_reading}) {
    if (progress) progress->cancel();
  }
  if (m_told) Q_EMIT givingUp();
}

bool RecordingFiles::cancelTold() {
  if (!m_told || m_progress->cancelled()) return false;
  cancel();
  return true;
}

void RecordingFiles::save(const QString& path) {
  if (!m_session.engine() || m_session.isBroken()) {
    Q_EMIT saveFailed(path, kNoScene, false);
    return;
  }
  begin();
  const RunRecord* record = &m_session.engine()->recording();
  auto job = [this, path, project = m_session.document().project(), record, progress = m_progress](uint64_t begun) {
    const ProgressScope scope(progress.get());
    QString problem;
    bool cancelled = false, kept = true;
    size_t frames = 0;
    try {
      record->settle();
      const RunContent content = record->content();
      kept = content.begun == begun;
      if (!kept) throw InputError("another run took the place of the one that was to be saved before it was written");
      frames = content.present.frames.size();
      RecordingWriter writer(path.toStdString(), project);
      writer.add(content);
      writer.finish();
    } catch (const Cancelled&) {
      cancelled = true;
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(this, [this, path, problem, cancelled, kept, frames] {
      end();
      if (!problem.isEmpty())
        Q_EMIT saveFailed(path, problem, kept);
      else if (!cancelled)
        Q_EMIT saved(path, frames);
    });
  };
  m_session.engine()->keepState();
  m_waiting.push_back({path, record->begun(), std::move(job)});
  auto answer = std::make_shared<Answer>(m_session, this);
  m_session.engine()->ask([answer = std::move(answer), record](const Engine&) { answer->begun = record->begun(); });
}

bool RecordingFiles::keep(const QString& path, size_t most) {
  if (m_reading) m_reading->cancel();
  const SnapshotPtr newest = m_session.newest();
  EngineThread* engine = m_session.engine();
  // The one of last time, which has not come back yet, is there for the next time.
  if (!m_keptIsBack && (!newest || engine->making() || newest->stats.frame == 0)) return QFile::exists(path);
  QFile::remove(path);
  if (!newest || engine->making() || m_session.isBroken()) return false;
  if (newest->stats.frame == 0 && !m_session.document().project().state) return false;  // it opens there anyway
  const RunRecord& record = engine->recording();
  const auto asked = std::make_shared<std::promise<uint64_t>>();
  const std::future<uint64_t> answer = asked->get_future();
  engine->keepState();
  engine->ask([asked, &record](const Engine&) { asked->set_value(record.begun()); });
  if (answer.wait_for(kPatience) != std::future_status::ready) return false;
  bool kept = false;
  m_worker.run([&] {
    try {
      record.settle();
      RunContent content = record.content();
      if (const RunRecord::Cost cost = record.cost(); cost.bytes + cost.disk > most) content = endOf(content);
      RecordingWriter writer(path.toStdString(), m_session.document().project());
      writer.add(content);
      writer.finish();
      kept = true;
    } catch (const std::exception& problem) {
      log(LogLevel::Warning, "The run is not kept: " + std::string(problem.what()));
    }
  });
  m_worker.wait();
  return kept;
}

void RecordingFiles::onAnswer(std::optional<uint64_t> begun) {
  Waiting one = std::move(m_waiting.front());
  m_waiting.pop_front();
  if (begun) {
    m_worker.run([write = std::move(one.write), begun = *begun] { write(begun); });
    return;
  }
  end();
  Q_EMIT saveFailed(one.path, kNoScene, false);
}

void RecordingFiles::open(const QString& path) {
  const QFileInfo info(path);
  const QString project = info.absolutePath() + QLatin1Char('/') + info.completeBaseName() + QStringLiteral(".json");
  if (QFileInfo(project).isFile() && beside(project) == info.absoluteFilePath())
    m_session.files().open(project);
  else
    read(info.absoluteFilePath(), Way::Alone);
}

void RecordingFiles::read(const QString& path, Way way) {
  if (!m_session.isReady()) return;
  begin();
  m_reading = m_progress;
  m_worker.run([this, path, way, project = m_session.document().project(), plugins = m_session.registry(),
                count = m_session.document().changeCount(), progress = m_progress] {
    const ProgressScope scope(progress.get());
    auto read = std::make_shared<Read>();
    try {
      const RecordingReader reader(path.toStdString(), *plugins);
      if (!reader.whyNoStates().empty())
        throw InputError("nothing can go on from it, and so it is not shown here: " + reader.whyNoStates());
      auto own = std::make_shared<Project>(readProject(reader.projectText(), path.toStdString(), *plugins).project);
      read->content = std::make_shared<const RunContent>(reader.content());
      read->same = way == Way::Alone || sameScene(*own, project);
      read->project = std::move(own);
      read->damage = QString::fromStdString(reader.damage());
    } catch (const Cancelled&) {
      read->cancelled = true;
    } catch (const std::exception& error) {
      read->problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(this, [this, path, way, read, count] {
      end();
      if (way == Way::Kept) {
        if (takeKept(*read, count)) return;
        m_keptIsBack = true;
        Q_EMIT cameBack(false);
        attachBeside(m_session.document().path());
      } else if (!read->problem.isEmpty()) {
        Q_EMIT openFailed(path, read->problem);
      } else if (!read->cancelled) {
        if (way == Way::Alone) m_session.files().openRecorded(*read->project);
        take(path, *read, way == Way::Beside ? count : m_session.document().changeCount());
      }
    });
  });
}

/// Nobody asked for it, so it is taken as it was or not at all. True where another project has taken its place, too.
bool RecordingFiles::takeKept(const Read& read, uint64_t count) {
  Document& document = m_session.document();
  if (!document.had(count) || !m_session.engine()) return true;
  if (!read.content || !read.same || document.changeCount() != count) return false;
  m_session.engine()->adopt(read.content, true, [session = &m_session, files = QPointer<RecordingFiles>(this)] {
    QMetaObject::invokeMethod(session, [files] {
      if (files) files->isBack();
    });
  });
  return true;
}

/// Its file stays open for as long as anything of it is looked at.
void RecordingFiles::isBack() {
  m_keptIsBack = true;
  if (m_session.autosave()) QFile::remove(m_session.autosave()->runPath());
  Q_EMIT cameBack(true);
}

void RecordingFiles::take(const QString& path, const Read& read, uint64_t count) {
  Document& document = m_session.document();
  if (!document.had(count) || !m_session.engine()) return;  // another project has taken its place
  const bool same = read.same && document.changeCount() == count;
  QString remark = read.damage;
  if (!same) {
    remark = QStringLiteral("It is of another version of this project; what goes on from it goes by the present one");
  }
  const auto& frames = read.content->present.frames;
  const double from = frames.empty() ? 0 : frames.begin()->second->stats.time;
  const double to = frames.empty() ? 0 : frames.rbegin()->second->stats.time;
  // Where the scene cannot stand there, an event says why.
  const auto adopted = [session = &m_session, files = QPointer<RecordingFiles>(this), path, from, to, remark] {
    QMetaObject::invokeMethod(session, [=] {
      if (files) Q_EMIT files->opened(path, from, to, remark);
    });
  };
  m_session.engine()->adopt(read.content, same, adopted);
}

}  // namespace ps
