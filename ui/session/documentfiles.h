// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QStringList>

#include <optional>

namespace ps {

class Document;
class Worker;
struct AutosavedSession;
struct ReplacedWork;

/// Opens and saves a document's project on a worker thread: the interface goes on meanwhile, and a project that cannot
/// be read leaves the present one as it is; one of which no scene can be made opens, to be mended. Results come as signals on the thread of this object. What opens a project
/// needs the document's plugins.
class DocumentFiles : public QObject {
  Q_OBJECT
 public:
  /// `worker` must end before this object does.
  DocumentFiles(Document& document, Worker& worker, QObject* parent = nullptr);

  void open(const QString& path);
  /// Though plugins are missing that the project cannot do without, by its own word: what they made stands still.
  void openAnyway(const QString& path);
  /// Whether it was for them that openFailed() came.
  static bool lacksRequired(const QString& problem);
  /// What an earlier session had open: its copy when it has one (the document is then dirty), else its file, seen as
  /// it was left.
  void reopen(const AutosavedSession& session);
  void bringBack(const ReplacedWork& work);  ///< dirty, without its history
  void newProject();                         ///< paused: there is nothing to run
  void save(const QString& path);

  static QStringList recent();  ///< newest first, existing files only
  static void addRecent(const QString& path);

 Q_SIGNALS:
  void opened(const QString& path, const QStringList& warnings, double seconds);
  void reopened(const ps::AutosavedSession& session);  ///< before opened()
  void openFailed(const QString& path, const QString& problem);
  /// `present`: what was saved is still the open project.
  void saved(const QString& path, bool present);
  /// Before saved(): the project would not open at its state any more, `why`, and it was left out. The document keeps
  /// it, so that the next save has it where an undo makes it fit again.
  void stateLeftOut(const QString& path, const QString& why);
  void saveFailed(const QString& path, const QString& problem, bool present);

 private:
  void load(const QString& path, const std::optional<AutosavedSession>& session, bool anyway = false);
  Document& m_document;
  Worker& m_worker;
  int m_request = 0;  ///< of the newest open(): an older one that arrives late is dropped
};

}  // namespace ps
