// SPDX-License-Identifier: Apache-2.0
#include "ui/session/cachefolder.h"

#include "core/io/outputfile.h"

#include <QtCore/QDateTime>
#include <QtCore/QDir>
#include <QtCore/QFile>
#include <QtCore/QFileInfo>

namespace ps {

void tidyCache(const QString& folder, const CacheBound& bound) {
  const QDir dir(folder);
  if (!dir.exists()) return;
  removeLeftParts(folder.toStdString(), {});
  const QDateTime oldest = QDateTime::currentDateTime().addDays(-bound.days);
  qint64 bytes = 0;
  for (const QFileInfo& file : dir.entryInfoList(QDir::Files, QDir::Time)) {  // the newest first
    bytes += file.size();
    if (bytes > bound.bytes || file.lastModified() < oldest) QFile::remove(file.filePath());
  }
}

void useCached(const QString& path) {
  const QDateTime now = QDateTime::currentDateTime();
  if (QFileInfo(path).lastModified() > now.addDays(-1)) return;
  QFile file(path);
  if (file.open(QIODevice::ReadWrite | QIODevice::ExistingOnly))
    file.setFileTime(now, QFileDevice::FileModificationTime);
}

}  // namespace ps
