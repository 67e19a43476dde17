// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QElapsedTimer>
#include <QtCore/QFileSystemWatcher>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QTimer>

namespace ps {

class Document;
class DocumentFiles;

/// Has the document's file looked at when something happens to it: at once where the system tells, and whenever the
/// program becomes the active one, since folders of other machines tell nothing.
class FileWatch : public QObject {
  Q_OBJECT
 public:
  FileWatch(const Document& document, DocumentFiles& files, QObject* parent = nullptr);

 private:
  void follow();
  void watch();

  const Document& m_document;
  DocumentFiles& m_files;
  QFileSystemWatcher m_watcher;
  QTimer m_rest;
  QElapsedTimer m_first;  ///< since the first of the signs that are rested for
  QString m_path;         ///< of the file that is watched; "": none
};

}  // namespace ps
