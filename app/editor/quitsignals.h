// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QObject>
#include <QtCore/QSocketNotifier>

#include <functional>
#include <memory>

namespace ps {

/// Calls `close` on the thread of this object when the program is asked to end: SIGTERM, SIGHUP (the terminal went) or
/// SIGINT. One that is ignored, as by nohup, stays ignored. One object at a time.
class QuitSignals : public QObject {
  Q_OBJECT
 public:
  explicit QuitSignals(std::function<void()> close, QObject* parent = nullptr);

 private:
  std::function<void()> m_close;
  std::unique_ptr<QSocketNotifier> m_notifier;
};

}  // namespace ps
