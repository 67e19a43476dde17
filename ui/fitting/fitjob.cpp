// SPDX-License-Identifier: Apache-2.0
#include "ui/fitting/fitjob.h"

#include <exception>
#include <utility>

namespace ps {

FitJob::FitJob(QObject* parent) : QObject(parent) {}

FitJob::~FitJob() {
  m_thread.request_stop();
  if (m_thread.joinable()) m_thread.join();  // before what it tells goes
}

void FitJob::start(std::shared_ptr<const Project> project, std::shared_ptr<PluginRegistry> plugins, FitTask task) {
  if (m_running) return;
  m_running = true;
  // What it says arrives in order, on the interface's thread; nothing arrives once this has gone.
  const auto tell = [this](auto&& say) { QMetaObject::invokeMethod(this, say, Qt::QueuedConnection); };
  const auto end = [this, tell](auto&& say) {
    tell([this, say] {
      m_running = false;
      say();
    });
  };
  m_thread = std::jthread([this, tell, end, project = std::move(project), plugins = std::move(plugins),
                           task = std::move(task)](const std::stop_token& stop) {
    try {
      const FitResult result = fitToCurve(
          *project, *plugins, task, [&stop] { return stop.stop_requested(); },
          [this, tell](const FitTrial& trial) { tell([this, trial] { Q_EMIT tried(trial); }); });
      end([this, result] { Q_EMIT finished(result); });
    } catch (const std::exception& error) {
      end([this, problem = QString::fromUtf8(error.what())] { Q_EMIT failed(problem); });
    }
  });
}

}  // namespace ps
