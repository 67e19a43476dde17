// SPDX-License-Identifier: Apache-2.0
#include "ui/window/filenames.h"

#include "ui/document/document.h"
#include "ui/session/documentfiles.h"
#include "ui/session/preferences.h"
#include "ui/session/session.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtCore/QPointer>
#include <QtCore/QRegularExpression>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QHeaderView>
#include <QtWidgets/QTreeView>

namespace ps {
namespace {

/// "" when given up, and where the dialog has gone meanwhile with its parent, which may close by itself. Where the
/// desktop has no dialog of its own, Qt's has its columns as wide as their texts.
QString chosenIn(const QPointer<QFileDialog>& dialog) {
  if (auto* list = dialog->findChild<QTreeView*>(QStringLiteral("treeView"))) {
    dialog->resize(760, 480);
    QHeaderView* header = list->header();
    header->setStretchLastSection(false);
    for (int column = 0; column < header->count(); ++column)
      header->setSectionResizeMode(column, column == 0 ? QHeaderView::Stretch : QHeaderView::ResizeToContents);
  }
  const bool chosen = dialog->exec() == QDialog::Accepted;
  const QString path = chosen && dialog ? dialog->selectedFiles().constFirst() : QString();
  delete dialog;
  return path;
}

/// Of a folder that is not there Qt would make a file's name.
QString present(const QString& folder) { return QDir(folder).exists() ? folder : QDir::homePath(); }

}  // namespace

QString nameOf(const QString& path) {
  return path.isEmpty() ? QStringLiteral("New scene") : QFileInfo(path).fileName();
}

QString fileNameFor(QString title) {
  return title.replace(QRegularExpression(QStringLiteral("[/\\\\:*?\"<>|]")), QStringLiteral("-"));
}

QString fileToWrite(QWidget* parent, const QString& title, const QString& suggestion, const QString& filter) {
  const QPointer dialog(new QFileDialog(parent, title, present(QFileInfo(suggestion).path()), filter));
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->setDefaultSuffix(QFileInfo(suggestion).suffix());
  dialog->selectFile(QFileInfo(suggestion).fileName());
  return chosenIn(dialog);
}

QString fileToRead(QWidget* parent, const QString& title, const QString& folder, const QString& filter) {
  const QPointer dialog(new QFileDialog(parent, title, present(folder), filter));
  dialog->setFileMode(QFileDialog::ExistingFile);
  return chosenIn(dialog);
}

QString folderToUse(QWidget* parent, const QString& title, const QString& folder) {
  const QPointer dialog(new QFileDialog(parent, title, present(folder)));
  dialog->setFileMode(QFileDialog::Directory);
  dialog->setOption(QFileDialog::ShowDirsOnly);
  return chosenIn(dialog);
}

QString folderBeside(Session& session) {
  const QString& own = session.document().path();
  return own.isEmpty() || session.files().isSample(own) ? preferences::projectFolder() : QFileInfo(own).path();
}

}  // namespace ps
