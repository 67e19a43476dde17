// SPDX-License-Identifier: Apache-2.0
#include "ui/window/droppedfiles.h"

#include "ui/window/bodyactions.h"

#include <QtCore/QFileInfo>

namespace ps {

DroppedFiles::DroppedFiles(const QList<QUrl>& urls) {
  QStringList others, why;
  for (const QUrl& url : urls) {
    const QFileInfo file(url.toLocalFile());
    if (!url.isLocalFile())
      why << QStringLiteral("“%1” is not on this computer: save it here first.").arg(url.toDisplayString());
    else if (file.isDir())
      why << QStringLiteral("“%1” is a folder: drop the files in it.").arg(file.fileName());
    else
      (BodyActions::isMesh(file.filePath()) ? meshes : others) << file.filePath();
  }
  if (others.size() == 1 && meshes.isEmpty()) {
    project = others.front();
  } else {
    for (const QString& path : others)
      why << QStringLiteral("“%1” is no mesh: a project takes the place of the scene, so drop it alone.")
                 .arg(QFileInfo(path).fileName());
  }
  constexpr qsizetype kMost = 2;
  const qsizetype more = why.size() - kMost;
  if (more > 0) why = why.mid(0, kMost) << QStringLiteral("%1 more were not taken.").arg(more);
  problems = why.join(QLatin1Char(' '));
}

}  // namespace ps
