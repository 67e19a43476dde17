// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/experiments/curvefit.h"

#include <QtCore/QObject>
#include <QtCore/QString>

#include <memory>
#include <thread>

namespace ps {

/// A search for values on a thread of its own, with engines of its own: the scene that is shown takes no part in it.
class FitJob : public QObject {
  Q_OBJECT
 public:
  explicit FitJob(QObject* parent = nullptr);
  ~FitJob() override;  ///< gives up, and waits for the frame that runs

  void start(std::shared_ptr<const Project> project, std::shared_ptr<PluginRegistry> plugins, FitTask task);
  void cancel() { m_thread.request_stop(); }  ///< finished() follows, with what was found until then
  bool isRunning() const { return m_running; }

 Q_SIGNALS:
  void tried(const ps::FitTrial& trial);
  void finished(const ps::FitResult& result);
  void failed(const QString& problem);

 private:
  bool m_running = false;
  std::jthread m_thread;
};

}  // namespace ps
