// SPDX-License-Identifier: Apache-2.0
// A handler may do next to nothing: it writes a byte into a pipe, and the event loop reads it.
#include "app/editor/quitsignals.h"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace ps {
namespace {

int pipeEnds[2] = {-1, -1};

void onSignal(int) {
  const int before = errno;
  const char byte = 0;
  [[maybe_unused]] const ssize_t written = ::write(pipeEnds[1], &byte, 1);  // a full pipe has told enough
  errno = before;
}

}  // namespace

QuitSignals::QuitSignals(std::function<void()> close, QObject* parent) : QObject(parent), m_close(std::move(close)) {
  if (::pipe2(pipeEnds, O_CLOEXEC | O_NONBLOCK) != 0) return;
  m_notifier = std::make_unique<QSocketNotifier>(pipeEnds[0], QSocketNotifier::Read);
  connect(m_notifier.get(), &QSocketNotifier::activated, this, [this] {
    char bytes[64];
    while (::read(pipeEnds[0], bytes, sizeof bytes) > 0) {
    }
    m_close();
  });
  for (const int number : {SIGTERM, SIGHUP, SIGINT}) {
    struct sigaction old {};
    if (::sigaction(number, nullptr, &old) != 0 || old.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = onSignal;
    action.sa_flags = SA_RESTART;
    ::sigaction(number, &action, nullptr);
  }
}

}  // namespace ps
