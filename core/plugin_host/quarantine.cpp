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
constexpr const char* kDraftSuffix = ".draft";
constexpr const char *kCrashed = ".crashed", *kSuspected = ".suspected", *kSound = ".sound";  // the kinds of records
constexpr const char* kUnspoken = "it crashed the program, or did not come back to it";

QString text(const std::string& s) { return QString::fromStdString(s); }

Quarantine::Entry describe(const std::string& id, const std::string& path) {
  const QFileInfo file(text(path));
  return {id, path, file.size(), file.lastModified().toMSecsSinceEpoch()};
}

QByteArray written(const Quarantine::Entry& entry) {
  const QJsonObject object{{"id", text(entry.id)},
                           {"path", text(entry.path)},
                           {"size", static_cast<qint64>(entry.size)},
                           {"modified", static_cast<qint64>(entry.modified)},
                           {"why", text(entry.why)}};
  return QJsonDocument(object).toJson(QJsonDocument::Compact);
}

bool read(const QByteArray& bytes, Quarantine::Entry& entry) {
  const QJsonObject object = QJsonDocument::fromJson(bytes).object();
  entry = {object["id"].toString().toStdString(), object["path"].toString().toStdString(), object["size"].toInteger(),
           object["modified"].toInteger(), object["why"].toString(QLatin1String(kUnspoken)).toStdString()};
  return !entry.id.empty() && !entry.path.empty();
}

QByteArray contents(const QString& path) {
  QFile file(path);
  constexpr qint64 kLongest = 1 << 16;
  return file.open(QIODevice::ReadOnly) ? file.read(kLongest) : QByteArray();
}

/// One record per file, so that two processes never write into one.
QString recordPath(const std::string& directory, const Quarantine::Entry& entry, const char* kind) {
  Hash hash;
  hash.add(entry.path.data(), entry.path.size());
  return text(directory) + QLatin1Char('/') + text(entry.id) + QLatin1Char('-') + text(hashText(hash.value())) +
         QLatin1String(kind);
}

bool sameBuild(const Quarantine::Entry& a, const Quarantine::Entry& b) {
  return a.id == b.id && a.path == b.path && a.size == b.size && a.modified == b.modified;
}

/// Whether there is such a record about this build.
bool isRecorded(const std::string& directory, const Quarantine::Entry& entry, const char* kind) {
  Quarantine::Entry found;
  return read(contents(recordPath(directory, entry, kind)), found) && sameBuild(found, entry);
}

/// Notes nothing where the directory cannot be written.
void record(const std::string& directory, const Quarantine::Entry& entry, const char* kind) {
  QFile file(recordPath(directory, entry, kind));
  if (file.open(QIODevice::WriteOnly)) file.write(written(entry));
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
    if (read(contents(text(path)), entry)) suspect(entry);
    ::unlink(path.c_str());
    ::close(file);
  }
  for (const QString& name : directory.entryList({QStringLiteral("*") + QLatin1String(kDraftSuffix)}, QDir::Files)) {
    const std::string path = directory.filePath(name).toStdString();
    const int file = lockedFile(path, O_RDWR);
    if (file < 0) continue;
    ::unlink(path.c_str());
    ::close(file);
  }
}

void Quarantine::suspect(const Entry& entry) {
  QFile::remove(recordPath(m_directory, entry, kSound));
  if (!isRecorded(m_directory, entry, kSuspected)) {
    record(m_directory, entry, kSuspected);
    return;
  }
  QFile::remove(recordPath(m_directory, entry, kSuspected));
  Entry crashed = entry;
  crashed.why = "the program ended twice in a row while it was loaded";
  record(m_directory, crashed, kCrashed);
}

void Quarantine::readRecords() {
  const QDir directory(text(m_directory));
  for (const QString& name : directory.entryList({QStringLiteral("*") + QLatin1String(kCrashed)}, QDir::Files)) {
    Entry entry;
    if (read(contents(directory.filePath(name)), entry)) m_entries.push_back(std::move(entry));
  }
}

std::string Quarantine::why(const std::string& id, const std::string& path) {
  const auto found = std::find_if(m_entries.begin(), m_entries.end(),
                                  [&](const Entry& entry) { return entry.id == id && entry.path == path; });
  if (found == m_entries.end()) return {};
  if (sameBuild(*found, describe(id, path))) return found->why;
  QFile::remove(recordPath(m_directory, *found, kCrashed));
  m_entries.erase(found);
  return {};
}

bool Quarantine::knows(const std::string& id, const std::string& path) const {
  return isRecorded(m_directory, describe(id, path), kSound);
}

void Quarantine::cameBack(const std::string& id, const std::string& path) {
  if (!QDir().mkpath(text(m_directory))) return;
  const Entry entry = describe(id, path);
  record(m_directory, entry, kSound);
  QFile::remove(recordPath(m_directory, entry, kSuspected));
}

void Quarantine::accuse(const std::string& id, const std::string& path, const std::string& why) {
  Entry entry = describe(id, path);
  entry.why = why;
  if (QDir().mkpath(text(m_directory))) record(m_directory, entry, kCrashed);
  for (const char* kind : {kSound, kSuspected}) QFile::remove(recordPath(m_directory, entry, kind));
  m_entries.push_back(std::move(entry));
}

std::pair<std::string, std::string> Quarantine::recordFor(const std::string& id, const std::string& path) const {
  Entry entry = describe(id, path);
  entry.why = kUnspoken;
  return {recordPath(m_directory, entry, kCrashed).toStdString(), written(entry).toStdString()};
}

bool Quarantine::allow(const std::string& id) { return allow(id, {}); }

bool Quarantine::allow(const std::string& id, const std::string& path) {
  const auto meant = [&](const Entry& entry) { return entry.id == id && (path.empty() || entry.path == path); };
  for (const Entry& entry : m_entries) {
    if (!meant(entry)) continue;
    for (const char* kind : {kCrashed, kSound}) QFile::remove(recordPath(m_directory, entry, kind));
  }
  return std::erase_if(m_entries, meant) > 0;
}

LoadingLock::LoadingLock(const std::string& directory, const std::string& id, const std::string& path) {
  static std::atomic<unsigned> counter{0};
  if (!QDir().mkpath(text(directory))) return;
  const std::string stem = directory + "/" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  // Locked and filled under another name first: a reader that sees the lock's name sees it locked and whole.
  const std::string draft = stem + kDraftSuffix;
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
