// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/io/filestamp.h"
#include "core/scene/project.h"
#include "ui/session/selection.h"

#include <QtCore/QDateTime>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QTimer>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ps {

class Document;
class FileLock;
class Worker;

enum class SessionEnd {
  None,      ///< it runs, or ended unexpectedly
  Replaced,  ///< another project took its place in the window
  Closed,    ///< with the window
};

/// What a graph shows beside its curves, in the units of its axes.
struct GraphLook {
  std::array<std::optional<double>, 2> cursors;                    ///< A and B, along its axis
  std::optional<std::pair<double, double>> range;                  ///< along its axis; nothing: it follows the data
  std::vector<std::optional<std::pair<double, double>>> values{};  ///< likewise of its axes of values
  bool operator==(const GraphLook&) const = default;
};

/// What a window showed at its end beside the project.
struct LastLook {
  std::vector<SelectedItem> selected;
  std::string material;                               ///< the current one; "": none was said
  bool playing = true;                                ///< whether the run went on
  std::optional<double> shownAt;                      ///< s, of a recorded frame that was shown instead of the newest
  bool hasRun = false;                                ///< whether notes::runPath() is of this end
  std::map<std::string, GraphLook> graphs{};          ///< by Graph::id
  std::optional<std::pair<double, double>> legend{};  ///< SI units; nothing: it follows what is there
  std::string brush{};                                ///< see textOf() of ui/tools/favouritebrush.h; "": none was said
};

/// What an earlier session left behind.
struct AutosavedSession {
  QString stem;         ///< of its files: see autosavenote.h
  QString copy;         ///< the project's copy; "" when everything was saved
  uint64_t change = 0;  ///< Document::changeCount() that it holds
  QString path;         ///< the file it belongs to; "" when it was never saved
  FileStamp file;       ///< what that file was, as the session knew it
  QString title;
  QDateTime time;
  SessionEnd end = SessionEnd::None;
  ViewState view;  ///< camera, section and colour at the end, without pins
  LastLook look;
};

/// Unsaved work whose place another project took, as it was: the way back needs no file.
struct ReplacedWork {
  AutosavedSession session;
  Project project;
};

/// Keeps a copy of unsaved work in the user's state directory: every 30 s, 2 s after the last change, when another
/// project takes its place, and at close. Closing therefore asks nothing, and a crash loses seconds. UI thread only;
/// files are written by the worker.
class Autosave : public QObject {
  Q_OBJECT
 public:
  static constexpr int kInterval = 30000;  ///< ms, before anybody says otherwise
  void setInterval(int seconds) { m_timer.setInterval(1000 * seconds); }
  static constexpr int kRest = 2000;  ///< ms without a change, after which a copy is made
  /// `directory`: created when missing. `worker` must end before this object does.
  Autosave(Document& document, Worker& worker, const QString& directory, QObject* parent = nullptr);
  ~Autosave() override;
  static QString standardDirectory();

  /// Sessions that run no longer and that this one has not taken over, newest first.
  std::vector<AutosavedSession> leftBehind() const;
  static void discard(const AutosavedSession& session);
  /// The document goes on with what `session` left: its run is at runPath() from here on, its other files go as soon as
  /// this session has written its own.
  void takeOver(const AutosavedSession& session);

  /// Where the run is kept when this session closes, and that of a session that was taken over waits to be read.
  QString runPath() const;
  /// Who knows what the window shows; {}: nobody does any more.
  void setLook(std::function<LastLook()> look) { m_look = std::move(look); }

  /// What the worker does around the replacement of a file by the document as it is now, so that no copy is ever
  /// offered that is older than the file: `before` with size and hash of the new bytes, `after` when they are there.
  struct AroundSave {
    std::function<void(const QString& path, const FileStamp& bytes)> before;
    std::function<void()> after;
  };
  AroundSave aroundSave() const;

  void start();    ///< the timer
  void saveNow();  ///< when something changed since the last copy, were it only the file that the work belongs to
  /// Last copy, with the note that the session ended in order, `hasRun`: whether its run is kept; blocks until it is
  /// written. Returns "", or why it could not be: the session then goes on.
  QString close(bool hasRun = false);

 Q_SIGNALS:
  void autosaved(const QDateTime& time);  ///< a copy of unsaved work is there
  /// Told once for each problem until a copy is written again. `replaced`: the copy was of work that is no longer open.
  void failed(const QString& problem, bool replaced);
  void workReplaced(const std::shared_ptr<const ps::ReplacedWork>& work);

 private:
  void takeStem();
  void putAside();
  void write(SessionEnd end);
  void written(const AutosavedSession& session, uint64_t count, const QStringList& takenOver, const QString& problem);
  AutosavedSession present(SessionEnd end) const;
  std::function<QString()> copyJob(const AutosavedSession& session) const;

  Document& m_document;
  Worker& m_worker;
  QString m_directory, m_stem, m_problem;
  std::function<LastLook()> m_look;
  std::unique_ptr<FileLock> m_lock;
  QTimer m_timer, m_rest;
  QStringList m_takenOver;  ///< stems
  uint64_t m_written = 0;   ///< Document::changeCount() of the last copy that was written
  bool m_moved = false;     ///< the work was saved, or belongs to another file, since the last copy
  int m_writing = 0, m_count = 0;
};

}  // namespace ps
