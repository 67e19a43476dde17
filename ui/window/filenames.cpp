// SPDX-License-Identifier: Apache-2.0
#include "ui/window/filenames.h"

#include <QtCore/QFileInfo>
#include <QtCore/QRegularExpression>
#include <QtWidgets/QFileDialog>

namespace ps {

QString nameOf(const QString& path) {
  return path.isEmpty() ? QStringLiteral("New scene") : QFileInfo(path).fileName();
}

QString fileNameFor(QString title) {
  return title.replace(QRegularExpression(QStringLiteral("[/\\\\:*?\"<>|]")), QStringLiteral("-"));
}

QString fileToWrite(QWidget* parent, const QString& title, const QString& suggestion, const QString& filter) {
  QFileDialog dialog(parent, title, QFileInfo(suggestion).path(), filter);
  dialog.setAcceptMode(QFileDialog::AcceptSave);
  dialog.setDefaultSuffix(QFileInfo(suggestion).suffix());
  dialog.selectFile(QFileInfo(suggestion).fileName());
  return dialog.exec() == QDialog::Accepted ? dialog.selectedFiles().constFirst() : QString();
}

}  // namespace ps
