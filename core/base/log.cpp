// SPDX-License-Identifier: Apache-2.0
#include "core/base/log.h"

#include <cstdio>
#include <mutex>

namespace ps {
namespace {
std::mutex& mutex() {
  static std::mutex m;
  return m;
}
LogHook& hook() {
  static LogHook h = [](LogLevel level, std::string_view message) {
    const char* prefix = level == LogLevel::Error ? "error: " : level == LogLevel::Warning ? "warning: " : "";
    std::fprintf(stderr, "%s%.*s\n", prefix, static_cast<int>(message.size()), message.data());
  };
  return h;
}
}  // namespace

void setLogHook(LogHook newHook) {
  const std::lock_guard lock(mutex());
  hook() = std::move(newHook);
}

void log(LogLevel level, std::string_view message) {
  const std::lock_guard lock(mutex());
  if (hook()) hook()(level, message);
}

}  // namespace ps
