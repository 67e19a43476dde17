// SPDX-License-Identifier: Apache-2.0
#pragma once
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

/// Writes what was recorded of the run as files for others, one after the other, by a thread of its own, while the run
/// goes on. Results come as signals.
class RunExport : public QObject {
  Q_OBJECT
 public:
  struct Task {
    QString what, where;  ///< "Surface, OBJ"; folder or file
    /// Writes, and returns how many frames. Advances the thread's progress, which begins at 0 with one stage of weight
    /// 1; throws Error and Cancelled.
    std::function<size_t(const KeptRun&)> write;
  };
  explicit RunExport(Session& session);
  ~RunExport() override;  ///< gives up what is being written

  void start(Task task);
  bool isBusy() const { return m_progress != nullptr; }
  int percent() const;  ///< -1 where nothing is written
  /// Gives up: files that are whole stay. False where there is nothing to give up.
  bool cancel();

 Q_SIGNALS:
  /// For a while already; `done` 0..1; `left` in s, -1 where it is too early to tell; often.
  void working(const QString& stage, double done, double left);
  void ended();  ///< after the last of those; and before what came of it
  void written(const QString& what, const QString& where, qulonglong frames);
  void failed(const QString& what, const QString& problem);
  void cancelled(const QString& what, const QString& where);

 private:
  struct Outcome;
  void tell();
  void finish(const Task& task, const Outcome& outcome);

  Session& m_session;
  std::shared_ptr<Progress> m_progress;  ///< nullptr: nothing is written
  QTimer m_clock;
  QElapsedTimer m_since;
  Worker m_worker;  // ends first
};

}  // namespace ps
