// SPDX-License-Identifier: Apache-2.0
// Libraries call exit() where the connection to the display is lost, as at a logout. It takes down what is static while
// the engine's thread computes with it, which ends in a crash. exit() first destroys what is local to its thread, then
// what is static, newest first. Why both a thread_local and atexit(): statics may be made at any time, and the first
// comes before all of them; but the display's connection may be lost on another thread than the main one.
#include "app/editor/suddenend.h"

#include "core/plugin_host/crashwatch.h"

#include <atomic>
#include <cstdlib>

namespace ps {
namespace {

std::atomic<bool> g_armed{false};

void endAtOnce() {
  if (!g_armed) return;
  accuseNobody();
  std::_Exit(1);
}

struct AtThreadsEnd {
  bool used = false;
  ~AtThreadsEnd() { endAtOnce(); }
};
thread_local AtThreadsEnd t_end;

}  // namespace

SuddenEnd::SuddenEnd() {
  t_end.used = true;  // made by its first use
  static const bool registered = std::atexit(endAtOnce) == 0;
  (void)registered;
  g_armed = true;
}

SuddenEnd::~SuddenEnd() { g_armed = false; }

}  // namespace ps
