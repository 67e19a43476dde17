// SPDX-License-Identifier: Apache-2.0
#include "ui/session/savejob.h"

#include "core/io/outputfile.h"
#include "core/io/projectio.h"
#include "core/simulation/projectstate.h"
#include "ui/session/versions.h"

#include <QtCore/QFileInfo>
#include <QtCore/QSysInfo>

namespace ps {
namespace {

QString userName() { return QString::fromLocal8Bit(qgetenv("USER")); }

QString lockNote() { return userName() + QStringLiteral(" on ") + QSysInfo::machineHostName(); }

}  // namespace

QString lockPath(const QString& project) {
  const QString canonical = QFileInfo(project).canonicalFilePath();
  const QFileInfo info(canonical.isEmpty() ? project : canonical);
  return QStringLiteral("%1/.%2.phasesketch-lock").arg(info.absolutePath(), info.fileName());
}

std::shared_ptr<FileLock> OwnFiles::lockOf(const QString& project, const std::shared_ptr<FileLock>& mine) {
  const std::string name = lockPath(project).toStdString();
  for (const std::shared_ptr<FileLock>& held : {mine, lock.lock()}) {
    if (!held || held->path() != name || !held->held()) continue;
    lock = held;
    return held;
  }
  auto made = std::make_shared<FileLock>(name, lockNote().toStdString());
  lock = made;
  return made;
}

QString holderText(const FileLock& lock) {
  const QString note = QString::fromStdString(lock.holder());
  return note == lockNote() ? QString() : note;
}

SaveJob::Result SaveJob::operator()() const {
  Result result;
  Project written = project;
  try {
    if (locks) result.lock = own->lockOf(path, lock);
    if (result.lock && result.lock->busy()) {
      const QString who = holderText(*result.lock);
      result.refusal = SaveRefusal::Elsewhere;
      result.problem = who.isEmpty() ? QStringLiteral("another window has it open")
                                     : QStringLiteral("another window has it open, of %1").arg(who);
      return result;
    }
    const std::string file = path.toStdString();
    const bool mine = own->path == path && holdsStamped(file, own->file);
    const bool seen = mine || (givenUp && holdsStamped(file, *givenUp));
    if (known && !seen && stampAt(file).known && !holdsStamped(file, *known)) {
      result.refusal = SaveRefusal::Changed;
      result.file = stampOfBytes(file);
      result.problem = QStringLiteral("another program has written it since it was opened or saved here");
      return result;
    }
    if (written.state && plugins)
      result.stateLeftOut = QString::fromStdString(whyStateDoesNotFit(*written.state, written, *plugins));
    if (!result.stateLeftOut.isEmpty()) written.state = nullptr;
    if (written.end && written.end->scene != sceneHash(written)) written.end.reset();  // it was of another scene
    const std::string bytes = writeProject(written);
    try {
      if (around.before) versions::keep(path);
    } catch (const std::exception& error) {
      result.noVersion = QString::fromUtf8(error.what());
    }
    try {
      if (around.before) around.before(path, {true, bytes.size(), 0, 0, hashOf(bytes)});
    } catch (const std::exception&) {
      // The copies go below; only a crash in between would find them older than the file.
    }
    result.file = writeFileAtomically(file, bytes);
    own->path = path;
    own->file = result.file;
    if (around.after) around.after();
  } catch (const std::exception& error) {
    result.problem = QString::fromUtf8(error.what());
  }
  return result;
}

}  // namespace ps
