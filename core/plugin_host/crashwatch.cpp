// SPDX-License-Identifier: Apache-2.0
#include "core/plugin_host/crashwatch.h"

#include "core/base/callee.h"
#include "core/plugin_host/quarantine.h"

#include <QDir>
#include <QString>

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>

namespace ps {
namespace {

/// What the handler needs of one plugin. Never changed once it is in the list, and never freed: a signal may come at
/// any time.
struct Record {
  std::string id, path, contents, words;
  const Record* older = nullptr;
};
std::atomic<const Record*> g_newest{nullptr};
std::atomic<bool> g_ending{false};

constexpr std::array<int, 5> kSignals{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
std::array<struct sigaction, kSignals.size()> g_before;

void writeAll(int file, const std::string& text) {
  size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count <= 0) return;
    done += static_cast<size_t>(count);
  }
}

const Record* recordOf(const char* id) {
  for (const Record* record = g_newest.load(); record; record = record->older) {
    if (std::strcmp(record->id.c_str(), id) == 0) return record;
  }
  return nullptr;
}

void writeRecord(const Record& record) {
  const int file = ::open(record.path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0) return;
  writeAll(file, record.contents);
  ::close(file);
}

/// Calls nothing but what may be called in a handler.
void onCrash(int signal) {
  for (size_t k = 0; k < kSignals.size(); ++k) {
    if (kSignals[k] == signal) ::sigaction(signal, &g_before[k], nullptr);
  }
  if (const Record* record = t_callee && !g_ending ? recordOf(t_callee) : nullptr) {
    writeAll(STDERR_FILENO, record->words);
    writeRecord(*record);
  }
  ::raise(signal);  // held back until this returns, then as if there were no handler
}

}  // namespace

void watchForCrashes(const Quarantine& quarantine) {
  QDir().mkpath(QString::fromStdString(quarantine.directory()));
  static const bool watching = [] {
    struct sigaction action {};
    action.sa_handler = onCrash;
    ::sigemptyset(&action.sa_mask);
    for (size_t k = 0; k < kSignals.size(); ++k) ::sigaction(kSignals[k], &action, &g_before[k]);
    return true;
  }();
  (void)watching;
}

void accuseNobody() { g_ending = true; }

void accuseNobodyAtExit() {
  static const bool registered = std::atexit(accuseNobody) == 0;
  (void)registered;
}

void noteForCrashes(const Quarantine& quarantine, const std::string& id, const std::string& path) {
  const auto [file, contents] = quarantine.recordFor(id, path);
  for (const Record* known = g_newest.load(); known; known = known->older) {
    if (known->id == id && known->path == file && known->contents == contents) {
      if (known == g_newest.load()) return;
      break;
    }
  }
  auto* record = new Record{id, file, contents,
                            "\nThe plugin '" + id +
                                "' crashed; it is in quarantine from now on. To allow it again: "
                                "phasesketch-cli plugins --allow " +
                                id + "\n",
                            g_newest.load()};
  while (!g_newest.compare_exchange_weak(record->older, record)) {
  }
}

bool putInQuarantine(const std::string& id) {
  const Record* record = g_ending ? nullptr : recordOf(id.c_str());
  if (record) writeRecord(*record);
  return record != nullptr;
}

void takeFromQuarantine(const std::string& id) {
  if (const Record* record = recordOf(id.c_str())) ::unlink(record->path.c_str());
}

}  // namespace ps
