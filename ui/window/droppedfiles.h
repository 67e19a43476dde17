// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QList>
#include <QtCore/QString>
#include <QtCore/QStringList>
#include <QtCore/QUrl>

namespace ps {

/// Files that were dropped on the window, and what can be done with them: meshes come into the scene, however many; a
/// project or a recording takes the place of the scene, and comes alone.
struct DroppedFiles {
  explicit DroppedFiles(const QList<QUrl>& urls);
  QStringList meshes;
  QString project;   ///< "": none is to be opened
  QString problems;  ///< "" or sentences: what of them is not taken, and why
};

}  // namespace ps
