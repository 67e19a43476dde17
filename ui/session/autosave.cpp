// SPDX-License-Identifier: Apache-2.0
#include "ui/session/autosave.h"

#include "core/io/outputfile.h"
#include "core/io/projectio.h"
#include "core/plugin_host/pluginpaths.h"
#include "ui/document/document.h"
#include "ui/session/worker.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QLockFile>

#include <algorithm>

namespace ps {
namespace {

constexpr const char* kEnds[] = {"", "replaced", "closed"};  // by SessionEnd

QJsonObject toJson(const ViewState& view) {
  QJsonObject json{{QStringLiteral("colour"), QString::fromStdString(view.colour)}};
  if (!view.camera) return json;
  const Vector3& target = view.camera->target;
  json.insert(QStringLiteral("target"), QJsonArray{target[0], target[1], target[2]});
  json.insert(QStringLiteral("distance"), view.camera->distance);
  json.insert(QStringLiteral("azimuth"), view.camera->azimuth);
  json.insert(QStringLiteral("elevation"), view.camera->elevation);
  return json;
}

ViewState viewOf(const QJsonObject& json) {
  ViewState view;
  view.colour = json.value(QStringLiteral("colour")).toString(QString::fromStdString(view.colour)).toStdString();
  if (!json.contains(QStringLiteral("target"))) return view;
  ViewCamera& camera = view.camera.emplace();
  const auto number = [&](const char* key, double& value) { value = json.value(QLatin1String(key)).toDouble(value); };
  const QJsonArray target = json.value(QStringLiteral("target")).toArray();
  for (int i = 0; i < 3; ++i)
    camera.target[static_cast<size_t>(i)] = target.at(i).toDouble(camera.target[static_cast<size_t>(i)]);
  number("distance", camera.distance);
  number("azimuth", camera.azimuth);
  number("elevation", camera.elevation);
  return view;
}

void writeNote(const AutosavedSession& session) {
  const QJsonObject note{{QStringLiteral("path"), session.path},
                         {QStringLiteral("title"), session.title},
                         {QStringLiteral("time"), session.time.toString(Qt::ISODateWithMs)},
                         {QStringLiteral("ended"), QString::fromLatin1(kEnds[static_cast<size_t>(session.end)])},
                         {QStringLiteral("unsaved"), !session.copy.isEmpty()},
                         {QStringLiteral("view"), toJson(session.view)}};
  writeFileAtomically((session.stem + QStringLiteral(".note")).toStdString(),
                      QJsonDocument(note).toJson().toStdString());
}

void discardFiles(const QString& stem) {
  for (const char* ending : {".note", ".json", ".lock"}) QFile::remove(stem + QLatin1String(ending));
}

}  // namespace

Autosave::Autosave(Document& document, Worker& worker, const QString& directory, QObject* parent)
    : QObject(parent), m_document(document), m_worker(worker), m_directory(directory) {
  QDir().mkpath(directory);
  takeStem();
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
  std::unique_ptr<QLockFile> lock;
  do {
    m_stem = QStringLiteral("%1/%2-%3-%4").arg(m_directory, now).arg(QCoreApplication::applicationPid()).arg(m_count++);
    lock = std::make_unique<QLockFile>(m_stem + QStringLiteral(".lock"));
    lock->setStaleLockTime(0);
  } while ((!lock->tryLock() && lock->error() == QLockFile::LockFailedError) ||
           QFile::exists(m_stem + QStringLiteral(".note")));
  m_lock = std::move(lock);
}

std::vector<AutosavedSession> Autosave::leftBehind() const {
  std::vector<AutosavedSession> sessions;
  const QDir dir(m_directory);
  for (const QString& name : dir.entryList({QStringLiteral("*.note")}, QDir::Files)) {
    AutosavedSession session;
    session.stem = dir.filePath(name.chopped(5));
    if (m_takenOver.contains(session.stem)) continue;
    QLockFile lock(session.stem + QStringLiteral(".lock"));
    lock.setStaleLockTime(0);
    if (!lock.tryLock()) continue;  // still running
    QFile file(dir.filePath(name));
    if (!file.open(QIODevice::ReadOnly)) continue;
    const QJsonObject note = QJsonDocument::fromJson(file.readAll()).object();
    session.path = note.value(QStringLiteral("path")).toString();
    session.title = note.value(QStringLiteral("title")).toString();
    session.time = QDateTime::fromString(note.value(QStringLiteral("time")).toString(), Qt::ISODateWithMs);
    session.view = viewOf(note.value(QStringLiteral("view")).toObject());
    const QString ended = note.value(QStringLiteral("ended")).toString();
    for (const SessionEnd end : {SessionEnd::Replaced, SessionEnd::Closed}) {
      if (ended == QLatin1String(kEnds[static_cast<size_t>(end)])) session.end = end;
    }
    const QString copy = session.stem + QStringLiteral(".json");
    if (note.value(QStringLiteral("unsaved")).toBool() && QFile::exists(copy)) session.copy = copy;
    sessions.push_back(session);
  }
  std::stable_sort(sessions.begin(), sessions.end(), [](const auto& a, const auto& b) { return a.time > b.time; });
  return sessions;
}

void Autosave::discard(const AutosavedSession& session) { discardFiles(session.stem); }

void Autosave::takeOver(const AutosavedSession& session) {
  m_takenOver.push_back(session.stem);
  write(SessionEnd::None);
}

void Autosave::start() { m_timer.start(); }

void Autosave::saveNow() {
  if (m_writing == 0 && (m_moved || m_written != m_document.changeCount())) write(SessionEnd::None);
}

QString Autosave::close() {
  if (m_document.changeCount() == 0) return {};  // nothing was open yet: the session before this one stands
  QString problem;
  m_worker.run([&problem, job = copyJob(present(SessionEnd::Closed))] { problem = job(); });
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
  if (m_document.isDirty()) session.copy = m_stem + QStringLiteral(".json");
  session.path = m_document.path();
  session.title = m_document.title();
  session.time = QDateTime::currentDateTime();
  session.end = end;
  session.view = m_document.project().view;
  return session;
}

/// What the worker has to do: "" when all is written, else the problem. The files of sessions taken over go last.
std::function<QString()> Autosave::copyJob(const AutosavedSession& session) const {
  return [session, project = m_document.project(), takenOver = m_takenOver] {
    try {
      if (session.copy.isEmpty()) {
        QFile::remove(session.stem + QStringLiteral(".json"));
      } else {
        saveProject(project, session.copy.toStdString());
      }
      writeNote(session);
    } catch (const std::exception& error) {
      return QString::fromUtf8(error.what());
    }
    for (const QString& stem : takenOver) discardFiles(stem);
    return QString();
  };
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
