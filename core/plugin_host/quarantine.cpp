// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/quarantine.h"

#include "core/base/hash.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QString>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>

namespace ps {
namespace {

constexpr const char* kLockSuffix = ".loading";
constexpr const char* kRecordSuffix = ".crashed";

QString text(const std::string& s) { return QString::fromStdString(s); }

Quarantine::Entry describe(const std::string& id, const std::string& path) {
  const QFileInfo file(text(path));
  return {id, path, file.size(), file.lastModified().toMSecsSinceEpoch()};
}

QByteArray written(const Quarantine::Entry& entry) {
  const QJsonObject object{{"id", text(entry.id)},
                           {"path", text(entry.path)},
                           {"size", static_cast<qint64>(entry.size)},
                           {"modified", static_cast<qint64>(entry.modified)}};
  return QJsonDocument(object).toJson(QJsonDocument::Compact);
}

bool read(const QByteArray& bytes, Quarantine::Entry& entry) {
  const QJsonObject object = QJsonDocument::fromJson(bytes).object();
  entry = {object["id"].toString().toStdString(), object["path"].toString().toStdString(), object["size"].toInteger(),
           object["modified"].toInteger()};
  return !entry.id.empty() && !entry.path.empty();
}

QByteArray contents(const QString& path) {
  QFile file(path);
  constexpr qint64 kLongest = 1 << 16;
  return file.open(QIODevice::ReadOnly) ? file.read(kLongest) : QByteArray();
}

/// One record per file, so that two processes never write into one.
QString recordPath(const std::string& directory, const Quarantine::Entry& entry) {
  Hash hash;
  hash.add(entry.path.data(), entry.path.size());
  return text(directory) + QLatin1Char('/') + text(entry.id) + QLatin1Char('-') + text(hashText(hash.value())) +
         QLatin1String(kRecordSuffix);
}

/// An owned descriptor with an exclusive lock, or -1.
int lockedFile(const std::string& path, int flags) {
  const int file = ::open(path.c_str(), flags | O_CLOEXEC, 0600);
  if (file < 0) return -1;
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  ::close(file);
  return -1;
}

}  // namespace

Quarantine::Quarantine(const std::string& directory) : m_directory(directory) {
  collectStaleLocks();
  readRecords();
}

void Quarantine::collectStaleLocks() {
  const QDir directory(text(m_directory));
  for (const QString& name : directory.entryList({QStringLiteral("*") + QLatin1String(kLockSuffix)}, QDir::Files)) {
    const std::string path = directory.filePath(name).toStdString();
    const int file = lockedFile(path, O_RDWR);
    if (file < 0) continue;  // its process lives
    Entry entry;
    if (read(contents(text(path)), entry)) {
      QFile record(recordPath(m_directory, entry));
      if (record.open(QIODevice::WriteOnly)) record.write(written(entry));
    }
    ::unlink(path.c_str());
    ::close(file);
  }
}

void Quarantine::readRecords() {
  const QDir directory(text(m_directory));
  for (const QString& name : directory.entryList({QStringLiteral("*") + QLatin1String(kRecordSuffix)}, QDir::Files)) {
    Entry entry;
    if (read(contents(directory.filePath(name)), entry)) m_entries.push_back(std::move(entry));
  }
}

bool Quarantine::holds(const std::string& id, const std::string& path) {
  const auto found = std::find_if(m_entries.begin(), m_entries.end(),
                                  [&](const Entry& entry) { return entry.id == id && entry.path == path; });
  if (found == m_entries.end()) return false;
  const Entry now = describe(id, path);
  if (now.size == found->size && now.modified == found->modified) return true;
  QFile::remove(recordPath(m_directory, *found));
  m_entries.erase(found);
  return false;
}

std::pair<std::string, std::string> Quarantine::recordFor(const std::string& id, const std::string& path) const {
  const Entry entry = describe(id, path);
  return {recordPath(m_directory, entry).toStdString(), written(entry).toStdString()};
}

bool Quarantine::allow(const std::string& id) {
  bool any = false;
  for (const Entry& entry : m_entries)
    if (entry.id == id) any |= QFile::remove(recordPath(m_directory, entry));
  std::erase_if(m_entries, [&](const Entry& entry) { return entry.id == id; });
  return any;
}

LoadingLock::LoadingLock(const std::string& directory, const std::string& id, const std::string& path) {
  static std::atomic<unsigned> counter{0};
  if (!QDir().mkpath(text(directory))) return;
  const std::string stem = directory + "/" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  // Locked and filled under another name first: a reader that sees the lock's name sees it locked and whole.
  const std::string draft = stem + ".draft";
  m_file = lockedFile(draft, O_RDWR | O_CREAT | O_TRUNC);
  if (m_file < 0) return;
  const QByteArray bytes = written(describe(id, path));
  m_path = stem + kLockSuffix;
  if (::write(m_file, bytes.constData(), static_cast<size_t>(bytes.size())) != bytes.size() ||
      ::rename(draft.c_str(), m_path.c_str()) != 0) {
    ::unlink(draft.c_str());
    ::close(m_file);
    m_file = -1;
  }
}

LoadingLock::~LoadingLock() {
  if (m_file < 0) return;
  ::unlink(m_path.c_str());
  ::close(m_file);
}

}  // namespace ps
