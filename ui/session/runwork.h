// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/messagelog.h"
#include "ui/session/worker.h"

#include <QtCore/QElapsedTimer>
#include <QtCore/QObject>
#include <QtCore/QString>
#include <QtCore/QTimer>

#include <functional>
#include <memory>

namespace ps {

class Progress;
class Session;
struct KeptRun;

/// Long work on what was recorded of the run or on the project, by a thread of its own, while the run goes on: exports,
/// films, copies for others. One at a time. Results come as signals.
class RunWork : public QObject {
  Q_OBJECT
 public:
  struct Result {
    QString text;  ///< sentences
    MessageLevel level = MessageLevel::Ok;
  };
  struct Task {
    QString what, where;  ///< "Surface, OBJ"; folder or file, "" where there is none
    /// Returns what to tell. Advances the thread's progress, which begins at 0 with one stage of weight 1;
    /// throws Error and Cancelled.
    std::function<Result(const KeptRun&)> act;
  };
  explicit RunWork(Session& session);
  ~RunWork() override;  ///< gives up what is being done

  void start(Task task);
  bool isBusy() const { return m_progress != nullptr; }
  QString stage() const;  ///< "Drawing"
  int percent() const;    ///< -1 where nothing is done
  /// Gives up: files that are whole stay. False where there is nothing to give up.
  bool cancel();
  bool isCancelled() const;  ///< it ends when what it is at is whole

 Q_SIGNALS:
  /// For a while already; `done` 0..1; `left` in s, -1 where it is too early to tell; often.
  void working(const QString& stage, double done, double left);
  void ended();  ///< after the last of those; and before what came of it
  void done(const QString& what, const QString& text, ps::MessageLevel level);
  void failed(const QString& what, const QString& problem);
  void cancelled(const QString& what, const QString& where);

 private:
  struct Outcome;
  void tell();
  void finish(const Task& task, const Outcome& outcome);

  Session& m_session;
  std::shared_ptr<Progress> m_progress;  ///< nullptr: nothing is done
  QTimer m_clock;
  QElapsedTimer m_since;
  Worker m_worker;  // ends first
};

}  // namespace ps
