// SPDX-License-Identifier: Apache-2.0
#include "ui/session/autosave.h"

#include "core/io/filelock.h"
#include "core/io/projectio.h"
#include "core/plugin_host/pluginpaths.h"
#include "ui/document/document.h"
#include "ui/session/autosavenote.h"
#include "ui/session/worker.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QDir>
#include <QtCore/QFile>

#include <algorithm>
#include <limits>

namespace ps {
Autosave::Autosave(Document& document, Worker& worker, const QString& directory, QObject* parent)
    : QObject(parent), m_document(document), m_worker(worker), m_directory(directory) {
  QDir().mkpath(directory);
  takeStem();
  worker.run([directory] { notes::tidy(directory); });
  m_timer.setInterval(kInterval);
  connect(&m_timer, &QTimer::timeout, this, &Autosave::saveNow);
  m_rest.setSingleShot(true);
  m_rest.setInterval(kRest);
  connect(&m_rest, &QTimer::timeout, this, &Autosave::saveNow);
  connect(&document, &Document::replacing, this, &Autosave::putAside);
  connect(&document, &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event)) m_takenOver.clear();
    if (std::holds_alternative<FileChanged>(event)) m_moved = true;
    if (!m_timer.isActive()) return;
    m_rest.start();
    // Until the note says so, a restored copy would belong to the file before, and be saved there.
    if (m_moved && (m_written == m_document.changeCount() || !m_document.isDirty())) saveNow();
  });
}

Autosave::~Autosave() = default;

QString Autosave::standardDirectory() { return QString::fromStdString(stateDirectory()) + QStringLiteral("/autosave"); }

/// A stem that no session has, locked. Without permission to lock, the first write says so.
void Autosave::takeStem() {
  const QString now = QDateTime::currentDateTimeUtc().toString(QStringLiteral("yyyyMMdd-HHmmss"));
  std::unique_ptr<FileLock> lock;
  do {
    m_stem = QDir(m_directory)
                 .filePath(QStringLiteral("%1-%2-%3").arg(now).arg(QCoreApplication::applicationPid()).arg(m_count++));
    lock = std::make_unique<FileLock>((m_stem + QStringLiteral(".lock")).toStdString());
  } while (lock->busy() || notes::sessions(m_directory).contains(m_stem));
  m_lock = std::move(lock);
}

std::vector<AutosavedSession> Autosave::leftBehind() const {
  std::vector<AutosavedSession> sessions;
  for (const auto& [stem, copies] : notes::sessions(m_directory)) {
    if (stem == m_stem || m_takenOver.contains(stem)) continue;
    if (FileLock::isHeld((stem + QStringLiteral(".lock")).toStdString())) continue;  // still running
    sessions.push_back(notes::read(stem, copies));
  }
  std::stable_sort(sessions.begin(), sessions.end(), [](const auto& a, const auto& b) { return a.time > b.time; });
  return sessions;
}

void Autosave::discard(const AutosavedSession& session) { notes::removeAll(session.stem); }

void Autosave::takeOver(const AutosavedSession& session) {
  m_takenOver.push_back(session.stem);
  if (session.look.hasRun) QFile::rename(notes::runPath(session.stem), runPath());
  write(SessionEnd::None);
}

void Autosave::start() { m_timer.start(); }

void Autosave::saveNow() {
  if (m_writing == 0 && (m_moved || m_written != m_document.changeCount())) write(SessionEnd::None);
}

QString Autosave::runPath() const { return notes::runPath(m_stem); }

QString Autosave::close(bool hasRun) {
  if (m_document.changeCount() == 0) return {};  // nothing was open yet: the session before this one stands
  AutosavedSession session = present(SessionEnd::Closed);
  session.look.hasRun = hasRun;
  QString problem;
  m_worker.run([&problem, job = copyJob(session)] { problem = job(); });
  m_worker.wait();
  if (!problem.isEmpty()) return problem;
  m_timer.stop();
  m_rest.stop();
  m_lock.reset();
  return {};
}

/// The files of this session stay as those of one that ended; what comes next is another session.
void Autosave::putAside() {
  const auto work =
      std::make_shared<const ReplacedWork>(ReplacedWork{present(SessionEnd::Replaced), m_document.project()});
  write(SessionEnd::Replaced);
  takeStem();
  Q_EMIT workReplaced(work);
}

AutosavedSession Autosave::present(SessionEnd end) const {
  AutosavedSession session;
  session.stem = m_stem;
  session.change = m_document.changeCount();
  if (m_document.isDirty()) session.copy = notes::copyPath(m_stem, session.change);
  session.path = m_document.path();
  session.file = m_document.file();
  session.title = m_document.title();
  session.time = QDateTime::currentDateTime();
  session.end = end;
  session.view = m_document.project().view;
  if (m_look) session.look = m_look();
  return session;
}

/// What the worker has to do: "" when all is written, else the problem. The files of sessions taken over go last.
std::function<QString()> Autosave::copyJob(const AutosavedSession& session) const {
  return [session, project = m_document.project(), takenOver = m_takenOver] {
    try {
      if (session.copy.isEmpty()) {
        notes::removeCopies(session.stem, session.change);
      } else {
        saveProject(project, session.copy.toStdString());
      }
      notes::write(session);
    } catch (const std::exception& error) {
      return QString::fromUtf8(error.what());
    }
    if (session.change > 0) notes::removeCopies(session.stem, session.change - 1);
    for (const QString& stem : takenOver) notes::removeAll(stem);
    return QString();
  };
}

/// What was taken over is in the document, whatever number it had there.
Autosave::AroundSave Autosave::aroundSave() const {
  std::vector<std::pair<QString, uint64_t>> older{{m_stem, m_document.changeCount()}};
  for (const QString& stem : m_takenOver) older.emplace_back(stem, std::numeric_limits<uint64_t>::max());
  return {[older](const QString& path, const FileStamp& bytes) {
            for (const auto& [stem, change] : older) notes::announceSave(stem, change, path, bytes);
          },
          [older] {
            for (const auto& [stem, change] : older) notes::removeCopies(stem, change);
          }};
}

void Autosave::write(SessionEnd end) {
  ++m_writing;
  m_moved = false;
  const AutosavedSession session = present(end);
  m_worker.run([this, session, count = m_document.changeCount(), takenOver = m_takenOver, job = copyJob(session)] {
    const QString problem = job();
    QMetaObject::invokeMethod(
        this, [this, session, count, takenOver, problem] { written(session, count, takenOver, problem); });
  });
}

void Autosave::written(const AutosavedSession& session, uint64_t count, const QStringList& takenOver,
                       const QString& problem) {
  --m_writing;
  const bool replaced = session.end == SessionEnd::Replaced, fresh = replaced || problem != m_problem;
  if (!replaced) m_problem = problem;
  if (!problem.isEmpty()) {
    m_moved = m_moved || !replaced;
    if (fresh) Q_EMIT failed(problem, replaced);
    return;
  }
  for (const QString& stem : takenOver) m_takenOver.removeAll(stem);
  m_written = std::max(m_written, count);
  if (m_moved && m_timer.isActive()) saveNow();  // the file came to be another one meanwhile
  if (!replaced && !session.copy.isEmpty()) Q_EMIT autosaved(session.time);
}

}  // namespace ps
