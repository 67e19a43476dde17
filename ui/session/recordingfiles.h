// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/worker.h"

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

 Q_SIGNALS:
  void working(const QString& stage, double done);  ///< for a while already; `done` 0..1; often
  void ended();                                     ///< after the last of those
  void saved(const QString& path, qulonglong frames);
  /// `kept`: the run is still there, to be saved elsewhere.
  void saveFailed(const QString& path, const QString& problem, bool kept);
  /// What was recorded, in s, and what is to be said of it, or "".
  void opened(const QString& path, double from, double to, const QString& remark);
  void openFailed(const QString& path, const QString& problem);

 private:
  struct Read;
  struct Answer;
  struct Waiting {
    QString path;
    uint64_t begun = 0;                         ///< RunRecord::begun() when it was asked for
    std::function<void(uint64_t begun)> write;  ///< the run that this many others came before
  };
  void onAnswer(std::optional<uint64_t> begun);
  void attach(const QString& path);  ///< to the project that is open
  void begin();
  void end();
  void read(const QString& path, bool attaching);
  void take(const QString& path, const Read& read, uint64_t count);

  Session& m_session;
  std::shared_ptr<Progress> m_progress, m_reading;  ///< of the newest job, and of the newest that reads
  int m_jobs = 0;
  QTimer m_clock;  ///< runs while there are any
  bool m_told = false;
  std::deque<Waiting> m_waiting;  ///< for the engine's newest state, in their order
  Worker m_worker;                // ends first, with what is to be written
};

}  // namespace ps
