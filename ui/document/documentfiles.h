// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QStringList>

namespace ps {

class Document;
class Worker;

/// Opens and saves a document's project on a worker thread: the interface goes on meanwhile, and a project that cannot
/// be read leaves the present one as it is. Results come as signals on the thread of this object.
class DocumentFiles : public QObject {
  Q_OBJECT
 public:
  /// `worker` must end before this object does.
  DocumentFiles(Document& document, Worker& worker, QObject* parent = nullptr);

  /// Needs the document's plugins. `play`: run at once. `restoreTo`: the path that the project belongs to when `path`
  /// is an autosaved copy of it ("" for one never saved); the document is then dirty.
  void open(const QString& path, bool play = true);
  void openCopy(const QString& path, const QString& restoreTo, bool play = true);
  void newProject();
  void save(const QString& path);

  static QStringList recent();  ///< newest first, existing files only
  static void addRecent(const QString& path);

 Q_SIGNALS:
  void opened(const QString& path, const QStringList& warnings, double seconds);
  void openFailed(const QString& path, const QString& problem);
  void saved(const QString& path);
  void saveFailed(const QString& path, const QString& problem);

 private:
  void load(const QString& path, const QString& documentPath, bool dirty, bool play);
  Document& m_document;
  Worker& m_worker;
  int m_request = 0;  ///< of the newest open(): an older one that arrives late is dropped
};

}  // namespace ps
