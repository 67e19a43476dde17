// SPDX-License-Identifier: Apache-2.0
#include "ui/session/versions.h"

#include "core/base/hash.h"
#include "core/io/outputfile.h"
#include "core/io/textfile.h"
#include "core/plugin_host/pluginpaths.h"

#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>

#include <filesystem>

namespace ps::versions {
namespace {

const QString kTime = QStringLiteral("yyyyMMdd-HHmmsszzz");  // UTC; names sort by it

/// One folder for a file, by whatever way it is reached.
QDir folderOf(const QString& path) {
  std::error_code problem;
  const std::string whole = std::filesystem::weakly_canonical(path.toStdString(), problem).string();
  const std::string name = hashText(hashOf(problem ? path.toStdString() : whole));
  return QDir(QString::fromStdString(stateDirectory() + "/versions/" + name));
}

/// Newest first.
QStringList namesIn(const QDir& folder) {
  return folder.entryList({QStringLiteral("*.json")}, QDir::Files, QDir::Name | QDir::Reversed);
}

}  // namespace

std::vector<Version> of(const QString& path) {
  std::vector<Version> versions;
  if (path.isEmpty()) return versions;
  const QDir folder = folderOf(path);
  for (const QString& name : namesIn(folder).mid(0, kKept)) {
    QDateTime time = QDateTime::fromString(name.section(QLatin1Char('.'), 0, 0), kTime);
    time.setTimeSpec(Qt::UTC);
    const QFileInfo info(folder.filePath(name));
    versions.push_back({info.filePath(), time.toLocalTime(), info.size()});
  }
  return versions;
}

void keep(const QString& path) {
  const QFileInfo info(path);
  if (!info.isFile()) return;
  const std::string bytes = readFile(path.toStdString(), kMaximumProjectBytes);
  const QDir folder = folderOf(path);
  folder.mkpath(QStringLiteral("."));
  removeLeftParts(folder.path().toStdString(), {});
  const QStringList before = namesIn(folder);
  if (!before.isEmpty()) {
    const std::string newest = folder.filePath(before.front()).toStdString();
    if (holdsStamped(newest, {true, bytes.size(), 0, 0, hashOf(bytes)})) return;
  }
  const QString name = info.lastModified().toUTC().toString(kTime) + QStringLiteral(".json");
  writeFileAtomically(folder.filePath(name).toStdString(), bytes);
  for (const QString& old : namesIn(folder).mid(kKept)) QFile::remove(folder.filePath(old));
}

}  // namespace ps::versions
