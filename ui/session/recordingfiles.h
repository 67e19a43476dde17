// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/worker.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QTimer>

#include <deque>
#include <functional>
#include <memory>
#include <optional>

namespace ps {

class Progress;
class Session;
struct RunContent;

/// The record of the run in files, written and read by a thread of its own: a recording is long, and the session's
/// worker unpacks what is looked at. One that lies beside a project is opened with it. Results come as signals.
class RecordingFiles : public QObject {
  Q_OBJECT
 public:
  explicit RecordingFiles(Session& session);
  ~RecordingFiles() override;  ///< waits until what is to be saved is written

  /// "ice.psrec" for "ice.json"; "" for "".
  static QString beside(const QString& project);
  /// With a state at the end of the run, which goes on meanwhile.
  void save(const QString& path);
  /// The project beside it where there is one, else the one that it holds; then its run, at its end.
  void open(const QString& path);
  /// Gives up what is being written or read: files stay as they were.
  void cancel();
  /// The same for what working() tells of; false where it tells of nothing, or that is given up already.
  bool cancelTold();
  /// All that is recorded, for when the window is opened again, with a state of now; of a run of more than `most` bytes
  /// its end alone; of one that has not come back yet, its file stays. Blocks until that is written, and what was to be
  /// written before, but waits no more than 3 s for a frame that the engine is amid. False: there is nothing to keep,
  /// or it could not be.
  bool keep(const QString& path, size_t most = kMostKept);
  static constexpr size_t kMostKept = size_t{64} << 20;

 Q_SIGNALS:
  /// For a while already; `done` 0..1; `left` in s, -1 where it is too early to tell; often.
  void working(const QString& stage, double done, double left);
  void givingUp();  ///< between those: it ends when what it is at is whole
  void ended();     ///< after the last of those
  void saved(const QString& path, qulonglong frames);
  /// `kept`: the run is still there, to be saved elsewhere.
  void saveFailed(const QString& path, const QString& problem, bool kept);
  /// What was recorded, in s, and what is to be said of it, or "".
  void opened(const QString& path, double from, double to, const QString& remark);
  void openFailed(const QString& path, const QString& problem);
  /// The run of a project that was reopened stands where it was left; or it could not be, and one beside the project is
  /// opened where there is one.
  void cameBack(bool whole);

 private:
  struct Read;
  struct Answer;
  struct Waiting {
    QString path;
    uint64_t begun = 0;                         ///< RunRecord::begun() when it was asked for
    std::function<void(uint64_t begun)> write;  ///< the run that this many others came before
  };
  void onAnswer(std::optional<uint64_t> begun);
  /// Whose run is read: that of a project which comes with it, of the one that is open, or of that one when its window
  /// was closed.
  enum class Way { Alone, Beside, Kept };
  void onOpened(const QString& project);
  void attachBeside(const QString& project);
  void begin();
  void end();
  void read(const QString& path, Way way);
  void take(const QString& path, const Read& read, uint64_t count);
  bool takeKept(const Read& read, uint64_t count);
  void isBack();

  Session& m_session;
  std::shared_ptr<Progress> m_progress, m_reading;  ///< of the newest job, and of the newest that reads
  int m_jobs = 0;
  QTimer m_clock;         ///< runs while there are any
  QElapsedTimer m_since;  ///< the newest began
  bool m_told = false;
  bool m_comesBack = false;       ///< the project that is being reopened has its run
  bool m_keptIsBack = true;       ///< else that one is being read yet, or about to stand there
  std::deque<Waiting> m_waiting;  ///< for the engine's newest state, in their order
  Worker m_worker;                // ends first, with what is to be written
};

}  // namespace ps
