// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/filestamp.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QStringList>

#include <memory>
#include <optional>

namespace ps {

class Autosave;
class Document;
class FileLock;
struct OwnFiles;
struct Project;
class Worker;
enum class SaveRefusal;
struct AutosavedSession;
struct ReplacedWork;

/// What another program did to the document's file since it was read or written here.
enum class OutsideChange { None, Written, Gone };

/// Opens and saves a document's project on a worker thread: the interface goes on meanwhile, and a project that cannot
/// be read leaves the present one as it is; one of which no scene can be made opens, to be mended. Results come as
/// signals on the thread of this object. What opens a project needs the document's plugins.
class DocumentFiles : public QObject {
  Q_OBJECT
 public:
  /// `worker` must end before this object does.
  DocumentFiles(Document& document, Worker& worker, QObject* parent = nullptr);

  /// From here on a project that is open is locked, so that another window knows, and what a file held before it was
  /// saved is kept; and no copy of unsaved work is offered later that is older than its file.
  void keepWith(const Autosave& autosave) { m_autosave = &autosave; }
  /// A file, or a folder of them, that everybody opens and nobody saves: never locked.
  void setSamples(const QString& place) { m_samples = place; }
  bool isSample(const QString& path) const;

  void open(const QString& path);
  /// A new project, no file's, that begins as the one at `path`.
  void openTemplate(const QString& path);
  /// What openFailed() came for last, a copy of unsaved work and an earlier version too, though plugins are missing
  /// that the project cannot do without, by its own word: what they made stands still.
  void openAnyway();
  /// What is being read is not opened, which openFailed() says without a problem. False where nothing is.
  bool giveUpOpening();
  /// Whether it was for them that openFailed() came.
  static bool lacksRequired(const QString& problem);
  /// What an earlier session had open: its copy when it has one (the document is then dirty), else its file, seen as
  /// it was left.
  void reopen(const AutosavedSession& session);
  void bringBack(const ReplacedWork& work);  ///< dirty, without its history
  void openRecorded(Project project);        ///< of a recording: paused, and no file's
  void newProject();                         ///< paused: there is nothing to run
  /// What the file was saved as before, as an unsaved change of the open project. `version`: of versions::of().
  void openVersion(const QString& version);
  /// Refused where another window has the file open, or another program has written it; `anyway`: not for the latter.
  void save(const QString& path, bool anyway = false);
  /// Looks, beside the interface, whether the document's file is what was read or written here: changedOutside() says
  /// what is new.
  void look();
  /// What another program wrote is given up: the next save replaces it, and until then the work counts as unsaved.
  void keepOurs();
  /// Another window has the file open that this one shows: its saves are refused from now on, ours are not.
  void takeOver();

  static QStringList recent();      ///< newest first, existing files only
  static QStringList everRecent();  ///< likewise, and those that are not where they were
  static void addRecent(const QString& path);
  static void forgetRecent(const QString& path);

 Q_SIGNALS:
  void opening(const QString& path);  ///< it is read from now on, until opened() or openFailed()
  void opened(const QString& path, const QStringList& warnings, double seconds);
  void reopened(const ps::AutosavedSession& session);  ///< before opened()
  /// After opened(): another window has it open, of `who` where that is somebody else.
  void openElsewhere(const QString& path, const QString& who);
  void tookOver(const QString& path, bool done);
  /// Once for everything that another program writes there; None: the file is again what was read or written here.
  void changedOutside(const QString& path, ps::OutsideChange change);
  void openFailed(const QString& path, const QString& problem);  ///< "" for `problem`: by who gave it up
  /// `present`: what was saved is still the open project.
  void saved(const QString& path, bool present);
  /// Before saved(): the project would not open at its state any more, `why`, and it was left out. The document keeps
  /// it, so that the next save has it where an undo makes it fit again. `present` as in saved().
  void stateLeftOut(const QString& path, const QString& why, bool present);
  void saveFailed(const QString& path, const QString& problem, bool present);
  /// The same, but the file could be replaced.
  void saveRefused(const QString& path, ps::SaveRefusal refusal, const QString& problem, bool present);
  void versionNotKept(const QString& path, const QString& problem);  ///< before saved()

 private:
  /// What is read, and what the document is to be then.
  struct Source {
    QString path, documentPath;
    bool dirty = false, anyway = false;
    FileStamp file;  ///< where the document's is not the one that is read
    std::shared_ptr<const AutosavedSession> session;
  };
  struct Read;
  /// What a look found, for as long as nobody writes: a file that was only touched would be read at each sign.
  struct Seen {
    FileStamp at;
    uint64_t knownHash = 0;
    bool same = false;
    FileStamp now;
  };
  /// What other programs do to the document's file.
  struct Outside {
    OutsideChange told = OutsideChange::None;               ///< last
    FileStamp file;                                         ///< of what was written
    std::optional<FileStamp> givenUp;                       ///< that of it which may be replaced
    std::optional<uint64_t> cleanAt;                        ///< count of changes that the file held before it was gone
    QElapsedTimer missing;                                  ///< since when it is not there
    std::shared_ptr<Seen> seen = std::make_shared<Seen>();  ///< by the worker's looks
  };
  void load(const Source& source);
  void adopt(const Source& source, Read& read);
  void supersede();
  bool locks(const QString& path) const { return m_autosave && !path.isEmpty() && !isSample(path); }
  void lockLater();
  void hear(bool same, const FileStamp& now);

  Document& m_document;
  Worker& m_worker;
  const Autosave* m_autosave = nullptr;
  QString m_samples;
  std::optional<Source> m_failed;    ///< what could not be opened last
  QString m_opening;                 ///< what is being read; "": nothing
  std::shared_ptr<FileLock> m_lock;  ///< of the document's file
  std::shared_ptr<OwnFiles> m_own;   ///< for the worker's jobs
  Outside m_outside;                 ///< since it was read or written here
  int m_request = 0;                 ///< of the newest open(): an older one that arrives late is dropped
};

}  // namespace ps
