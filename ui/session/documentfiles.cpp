// SPDX-License-Identifier: Apache-2.0
#include "ui/session/documentfiles.h"

#include "core/io/outputfile.h"
#include "core/io/projectio.h"
#include "core/io/recording.h"
#include "core/io/textfile.h"
#include "core/plugin_host/registry.h"
#include "ui/document/document.h"
#include "ui/document/missingplugins.h"
#include "ui/document/wallside.h"
#include "ui/session/autosave.h"
#include "ui/session/fileproblem.h"
#include "ui/session/recordingfiles.h"
#include "ui/session/savejob.h"
#include "ui/session/worker.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QSettings>
#include <QtCore/QTimer>

#include <algorithm>
#include <string_view>
#include <utility>

namespace ps {
namespace {

constexpr int kRecentFiles = 10;
constexpr const char* kRequiredPointer = "/pluginsRequired/";  // where loadProject() says that one is missing
constexpr int kGap = 1000;  // ms without a file: editors take it away before they put another there
constexpr const char* kRecentKey = "files/recent";

/// An empty tray to begin with, and what the plugins offer as standard.
Project emptyProject(const PluginRegistry* plugins) {
  Project project;
  if (plugins) {
    project.solver.thermalModel = plugins->standard(PluginKind::Thermal);
    SceneMaterial material;
    material.id = material.base = plugins->standard(PluginKind::Material);
    const Material* installed = plugins->material(material.base);
    if (installed) material.label = installed->label;
    if (!material.base.empty()) project.materials.push_back(material);
  }
  for (const WallSide& side : kWallSides) {
    if (std::string_view(side.id) != "lid")
      project.environment.walls.push_back(wallOn(side, {-0.3, 0, -0.3}, {0.3, 0.8, 0.3}));
  }
  project.environment.boundsMinimum = {-0.4, -0.2, -0.4};
  project.environment.boundsMaximum = {0.4, 1, 0.4};
  project.view.camera = ViewCamera();
  return project;
}

/// `anyway`: with its list of required plugins set aside while it is checked, and kept for the next save.
LoadedProject parse(const std::string& bytes, const QString& path, const PluginRegistry& plugins, bool anyway) {
  if (!anyway) return readProject(bytes, path.toStdString(), plugins);
  LoadedProject loaded = readProject(bytes, path.toStdString(), plugins, {"pluginsRequired=[]"});
  const QJsonObject json = QJsonDocument::fromJson(QByteArray::fromStdString(bytes)).object();
  for (const QJsonValue& id : json[QLatin1String("pluginsRequired")].toArray())
    loaded.project.pluginsRequired.push_back(id.toString().toStdString());
  return loaded;
}

/// The camera, section and colour of `seen`, with the pins and unknown keys of `stored`.
ViewState asSeen(ViewState stored, const ViewState& seen) {
  ViewState view = seen;
  view.pinned = std::move(stored.pinned);
  view.unknown = std::move(stored.unknown);
  return view;
}

/// QSettings waits for half a minute for the lock of a program that was killed before it had signed it.
void freeSettings() {
  const QString lock = QSettings().fileName() + QStringLiteral(".lock");
  if (QFile::exists(lock) && !FileLock::isHeld(lock.toStdString())) QFile::remove(lock);
}

}  // namespace

struct DocumentFiles::Read {
  LoadedProject loaded;
  QString problem;
  double seconds = 0;
  FileStamp file;
  std::shared_ptr<FileLock> lock;
};

DocumentFiles::DocumentFiles(Document& document, Worker& worker, QObject* parent)
    : QObject(parent), m_document(document), m_worker(worker), m_own(std::make_shared<OwnFiles>()) {
  freeSettings();
  connect(&document, &Document::changed, this, [this](const ChangeEvent& event) {
    if (std::holds_alternative<ProjectOpened>(event)) m_outside = {};
  });
}

/// Whatever way leads to it.
bool DocumentFiles::isSample(const QString& path) const {
  const QString samples = m_samples.isEmpty() ? QString() : QFileInfo(m_samples).canonicalFilePath();
  const QString file = QFileInfo(path).canonicalFilePath();  // "" of what is not there
  return !samples.isEmpty() && (file == samples || file.startsWith(samples + QLatin1Char('/')));
}

void DocumentFiles::open(const QString& path) {
  const QString absolute = QFileInfo(path).absoluteFilePath();
  load({absolute, absolute, false, false, {}, {}});
}

void DocumentFiles::openTemplate(const QString& path) {
  load({QFileInfo(path).absoluteFilePath(), {}, false, false, {}, {}});
}

void DocumentFiles::openAnyway() {
  if (!m_failed) return;
  Source source = *m_failed;
  source.anyway = true;
  load(source);
}

bool DocumentFiles::lacksRequired(const QString& problem) { return problem.contains(QLatin1String(kRequiredPointer)); }

void DocumentFiles::reopen(const AutosavedSession& session) {
  const bool dirty = !session.copy.isEmpty();
  load({dirty ? session.copy : session.path, session.path, dirty, false, session.file,
        std::make_shared<const AutosavedSession>(session)});
}

void DocumentFiles::openVersion(const QString& version) {
  load({version, m_document.path(), true, false, m_document.file(), {}});
}

void DocumentFiles::load(const Source& source) {
  const int request = ++m_request;
  const PluginRegistry* plugins = m_document.plugins();
  if (!plugins) {
    Q_EMIT openFailed(source.path, QStringLiteral("Plugins are still being loaded. Open it again in a moment."));
    return;
  }
  m_opening = source.path;
  Q_EMIT opening(source.path);
  m_worker.run([this, request, plugins, source, mine = m_lock, own = m_own, locks = locks(source.documentPath)] {
    QElapsedTimer clock;
    clock.start();
    auto read = std::make_shared<Read>();
    std::string bytes;
    try {
      const std::string path = source.path.toStdString();
      if (locks) removeLeftParts(source.documentPath.toStdString());
      read->file = stampAt(path);  // before the bytes: what is written meanwhile is noticed
      bytes = readFile(path, kMaximumProjectBytes);
      read->file.hash = hashOf(bytes);
      read->loaded = parse(bytes, source.path, *plugins, source.anyway);
      FileProblems problems(source.path, bytes);
      for (auto* messages : {&read->loaded.problems, &read->loaded.warnings}) {
        for (ProjectMessage& message : *messages) message.text = problems.said(message.text).toStdString();
      }
      if (locks) read->lock = own->lockOf(source.documentPath, mine);
    } catch (const std::exception& error) {
      read->problem = FileProblems(source.path, bytes).said(error.what());
    }
    read->seconds = static_cast<double>(clock.elapsed()) / 1000;
    QMetaObject::invokeMethod(this, [this, request, source, read] {
      if (request == m_request) adopt(source, *read);
    });
  });
}

/// The document becomes what was read.
void DocumentFiles::adopt(const Source& source, Read& read) {
  m_opening.clear();
  if (!read.problem.isEmpty()) {
    m_failed = source;
    Q_EMIT openFailed(source.path, read.problem);
    return;
  }
  const bool own = source.path == source.documentPath;
  Project& project = read.loaded.project;
  if (source.session && !source.dirty) project.view = asSeen(project.view, source.session->view);
  // What the scene says of them by itself, with ways out, is not said twice.
  const std::vector<MissingPlugin> missing = missingPlugins(project, *m_document.plugins());
  const auto saidAlready = [&](const ProjectMessage& message) {
    return std::any_of(missing.begin(), missing.end(), [&](const auto& one) { return one.id == message.plugin; });
  };
  QStringList warnings;
  // It opens though no scene can be made of it, to be mended.
  for (const auto* messages : {&read.loaded.problems, &read.loaded.warnings}) {
    for (const ProjectMessage& message : *messages) {
      if (!saidAlready(message)) warnings << QString::fromStdString(message.text);
    }
  }
  m_lock = read.lock;
  m_own = std::make_shared<OwnFiles>();  // what was saved before says nothing of what was read
  // A run that was recorded stands at its end, one that was left where it was left.
  const LastLook look = source.session ? source.session->look : LastLook();
  const bool play =
      look.playing && !look.hasRun && !isRecording(RecordingFiles::beside(source.documentPath).toStdString());
  m_document.open(std::move(project), source.documentPath, source.dirty, play, own ? read.file : source.file);
  if (!source.documentPath.isEmpty()) addRecent(source.documentPath);
  if (source.session) Q_EMIT reopened(*source.session);
  Q_EMIT opened(source.documentPath, warnings, read.seconds);
  if (m_lock && m_lock->busy()) Q_EMIT openElsewhere(source.documentPath, holderText(*m_lock));
}

/// Another project takes the place of the one that is being read.
void DocumentFiles::supersede() {
  ++m_request;
  m_opening.clear();
}

/// The worker reads it to its end all the same.
bool DocumentFiles::giveUpOpening() {
  if (m_opening.isEmpty()) return false;
  ++m_request;
  Q_EMIT openFailed(std::exchange(m_opening, QString()), QString());
  return true;
}

void DocumentFiles::bringBack(const ReplacedWork& work) {
  supersede();
  m_document.open(work.project, work.session.path, true, work.session.look.playing, work.session.file);
  lockLater();
  Q_EMIT reopened(work.session);
  Q_EMIT opened(work.session.path, {}, 0);
}

void DocumentFiles::openRecorded(Project project) {
  supersede();
  m_lock.reset();
  m_document.open(std::move(project), {}, false, false);  // nothing is lost with it: the recording has it
  Q_EMIT opened({}, {}, 0);
}

void DocumentFiles::newProject() {
  supersede();
  m_lock.reset();
  m_document.open(emptyProject(m_document.plugins()), {}, false, false);
  Q_EMIT opened({}, {}, 0);
}

/// Of the document's file, which is open already.
void DocumentFiles::lockLater() {
  const QString path = m_document.path();
  if (!locks(path)) {
    m_lock.reset();
    return;
  }
  m_worker.run([this, path, count = m_document.changeCount(), own = m_own, mine = std::exchange(m_lock, {})] {
    QMetaObject::invokeMethod(this, [this, path, count, lock = own->lockOf(path, mine)] {
      if (!m_document.had(count)) return;
      m_lock = lock;
      if (lock->busy()) Q_EMIT openElsewhere(path, holderText(*lock));
    });
  });
}

void DocumentFiles::takeOver() {
  if (!m_lock) return;
  m_worker.run([this, path = m_document.path(), lock = m_lock] {
    lock->takeOver();
    QMetaObject::invokeMethod(this, [this, path, done = lock->held()] { Q_EMIT tookOver(path, done); });
  });
}

void DocumentFiles::save(const QString& path, bool anyway) {
  const QString absolute = QFileInfo(path).absoluteFilePath();
  SaveJob job{absolute, m_document.project(), m_document.plugins(), {}, locks(absolute), m_lock, m_own, {}};
  if (!anyway && absolute == m_document.path()) {
    job.known = m_document.file();
    job.givenUp = m_outside.givenUp;
  }
  if (m_autosave) job.around = m_autosave->aroundSave();
  m_worker.run([this, job = std::move(job), count = m_document.changeCount()] {
    QMetaObject::invokeMethod(this, [this, result = job(), path = job.path, count] {
      if (result.refusal != SaveRefusal::None) {
        if (result.refusal == SaveRefusal::Changed && m_document.had(count)) {  // told by that
          m_outside.told = OutsideChange::Written;
          m_outside.file = result.file;
        }
        Q_EMIT saveRefused(path, result.refusal, result.problem, m_document.had(count));
        return;
      }
      if (!result.problem.isEmpty()) {
        Q_EMIT saveFailed(path, result.problem, m_document.had(count));
        return;
      }
      addRecent(path);
      if (m_document.had(count)) {
        m_lock = result.lock;
        m_outside = {};
      }
      if (!result.noVersion.isEmpty()) Q_EMIT versionNotKept(path, result.noVersion);
      if (!result.stateLeftOut.isEmpty()) Q_EMIT stateLeftOut(path, result.stateLeftOut, m_document.had(count));
      Q_EMIT saved(path, m_document.saved(path, count, result.file));
    });
  });
}

/// In line with our own saves, so that none of them is taken for somebody else's.
void DocumentFiles::look() {
  const QString path = m_document.path();
  const FileStamp known = m_document.file();
  if (path.isEmpty() || !known.known) return;
  m_worker.run([this, path, known, count = m_document.changeCount(), own = m_own, seen = m_outside.seen] {
    const std::string file = path.toStdString();
    const FileStamp at = stampAt(file);
    if (!isUntouched(seen->at, at) || seen->knownHash != known.hash) {
      const bool same = (own->path == path && holdsStamped(file, own->file)) || holdsStamped(file, known);
      *seen = {at, known.hash, same, same ? known : stampOfBytes(file)};
    }
    QMetaObject::invokeMethod(this, [this, path, count, same = seen->same, now = seen->now] {
      if (m_document.had(count) && m_document.path() == path) hear(same, now);
    });
  });
}

void DocumentFiles::hear(bool same, const FileStamp& now) {
  const OutsideChange change = same ? OutsideChange::None : now.known ? OutsideChange::Written : OutsideChange::Gone;
  if (change != OutsideChange::Gone) {
    m_outside.missing.invalidate();
  } else if (!m_outside.missing.isValid()) {
    m_outside.missing.start();
    QTimer::singleShot(kGap, Qt::PreciseTimer, this, &DocumentFiles::look);
    return;
  } else if (m_outside.missing.elapsed() < kGap && m_outside.told != OutsideChange::Gone) {
    return;  // the timer looks again
  }
  const bool alike = now.size == m_outside.file.size && now.hash == m_outside.file.hash;
  if (change == m_outside.told && (change != OutsideChange::Written || alike)) return;
  m_outside.told = change;
  m_outside.file = now;
  if (change == OutsideChange::Gone) {  // no file holds it any more
    m_outside.cleanAt = m_document.isDirty() ? std::nullopt : std::optional(m_document.changeCount());
    m_document.undoStack().resetClean();
  } else if (change == OutsideChange::None && m_outside.cleanAt == m_document.changeCount()) {
    m_document.undoStack().setClean();  // it is there again
  }
  Q_EMIT changedOutside(m_document.path(), change);
}

void DocumentFiles::keepOurs() {
  if (m_outside.told == OutsideChange::Written) m_outside.givenUp = m_outside.file;
  m_outside.cleanAt.reset();
  m_document.undoStack().resetClean();
}

QStringList DocumentFiles::recent() {
  QStringList existing;
  for (const QString& path : everRecent()) {
    if (QFileInfo(path).isFile()) existing << path;
  }
  return existing;
}

QStringList DocumentFiles::everRecent() { return QSettings().value(QLatin1String(kRecentKey)).toStringList(); }

void DocumentFiles::addRecent(const QString& path) {
  QStringList paths = everRecent();
  paths.removeAll(path);
  paths.prepend(path);
  QSettings().setValue(QLatin1String(kRecentKey), QVariant(paths.mid(0, kRecentFiles)));
}

void DocumentFiles::forgetRecent(const QString& path) {
  QStringList paths = everRecent();
  paths.removeAll(path);
  QSettings().setValue(QLatin1String(kRecentKey), QVariant(paths));
}

}  // namespace ps
