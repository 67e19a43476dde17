// SPDX-License-Identifier: Apache-2.0
#include "ui/document/autosave.h"

#include "core/io/projectio.h"
#include "core/plugin_host/pluginpaths.h"
#include "ui/document/document.h"
#include "ui/document/worker.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QJsonDocument>
#include <QtCore/QJsonObject>
#include <QtCore/QLockFile>
#include <QtCore/QSaveFile>

#include <algorithm>
#include <stdexcept>

namespace ps {
namespace {

void writeNote(const QString& file, const QJsonObject& note) {
  QSaveFile out(file);
  if (!out.open(QIODevice::WriteOnly) || out.write(QJsonDocument(note).toJson()) < 0 || !out.commit()) {
    throw std::runtime_error(out.errorString().toStdString());
  }
}

}  // namespace

Autosave::Autosave(Document& document, Worker& worker, const QString& directory, QObject* parent)
    : QObject(parent), m_document(document), m_worker(worker) {
  QDir().mkpath(directory);
  for (int n = 0; n < 1000 && !m_lock; ++n) {
    const QString stem =
        QStringLiteral("%1/%2-%3-%4")
            .arg(directory, QDateTime::currentDateTimeUtc().toString(QStringLiteral("yyyyMMdd-HHmmss")))
            .arg(QCoreApplication::applicationPid())
            .arg(n);
    auto lock = std::make_unique<QLockFile>(stem + QStringLiteral(".lock"));
    lock->setStaleLockTime(0);
    if (lock->tryLock()) {
      m_stem = stem;
      m_lock = std::move(lock);
    } else if (lock->error() != QLockFile::LockFailedError) {
      break;  // no permission: the first write says so
    }
  }
  if (m_stem.isEmpty()) m_stem = directory + QStringLiteral("/unlocked");
  m_timer.setInterval(kInterval);
  connect(&m_timer, &QTimer::timeout, this, &Autosave::saveNow);
}

Autosave::~Autosave() = default;

QString Autosave::standardDirectory() { return QString::fromStdString(stateDirectory()) + QStringLiteral("/autosave"); }

std::vector<AutosavedSession> Autosave::leftBehind(const QString& directory) {
  std::vector<AutosavedSession> sessions;
  const QDir dir(directory);
  for (const QString& name : dir.entryList({QStringLiteral("*.note")}, QDir::Files)) {
    AutosavedSession session;
    session.stem = dir.filePath(name.chopped(5));
    QLockFile lock(session.stem + QStringLiteral(".lock"));
    lock.setStaleLockTime(0);
    if (!lock.tryLock()) continue;  // still running
    QFile file(dir.filePath(name));
    if (!file.open(QIODevice::ReadOnly)) continue;
    const QJsonObject note = QJsonDocument::fromJson(file.readAll()).object();
    session.path = note.value(QStringLiteral("path")).toString();
    session.title = note.value(QStringLiteral("title")).toString();
    session.time = QDateTime::fromString(note.value(QStringLiteral("time")).toString(), Qt::ISODateWithMs);
    session.closed = note.value(QStringLiteral("closed")).toBool();
    const QString copy = session.stem + QStringLiteral(".json");
    if (note.value(QStringLiteral("unsaved")).toBool() && QFile::exists(copy)) session.copy = copy;
    sessions.push_back(session);
  }
  std::stable_sort(sessions.begin(), sessions.end(), [](const auto& a, const auto& b) { return a.time > b.time; });
  return sessions;
}

void Autosave::discard(const AutosavedSession& session) {
  for (const char* ending : {".note", ".json", ".lock"}) QFile::remove(session.stem + QLatin1String(ending));
}

void Autosave::start() { m_timer.start(); }

void Autosave::saveNow() {
  if (m_written != m_document.changeCount()) write(false);
}

void Autosave::close() {
  m_timer.stop();
  write(true);
  m_worker.wait();
  m_lock.reset();
}

void Autosave::write(bool closed) {
  m_written = m_document.changeCount();
  const bool unsaved = m_document.isDirty();
  const QDateTime time = QDateTime::currentDateTime();
  const QJsonObject note{{QStringLiteral("path"), m_document.path()},
                         {QStringLiteral("title"), m_document.title()},
                         {QStringLiteral("time"), time.toString(Qt::ISODateWithMs)},
                         {QStringLiteral("closed"), closed},
                         {QStringLiteral("unsaved"), unsaved}};
  m_worker.run([this, note, unsaved, time, stem = m_stem, project = m_document.project()] {
    QString problem;
    try {
      const QString copy = stem + QStringLiteral(".json");
      if (unsaved) {
        saveProject(project, copy.toStdString());
      } else {
        QFile::remove(copy);
      }
      writeNote(stem + QStringLiteral(".note"), note);
    } catch (const std::exception& error) {
      problem = QString::fromUtf8(error.what());
    }
    QMetaObject::invokeMethod(this, [this, time, problem] {
      if (problem.isEmpty()) {
        Q_EMIT autosaved(time);
      } else {
        Q_EMIT failed(problem);
      }
    });
  });
}

}  // namespace ps
