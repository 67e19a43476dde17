// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <string_view>

namespace ps {

enum class LogLevel { Info, Warning, Error };

/// The host owns the log: the editor shows it under Messages, the command line writes it to standard error.
using LogHook = std::function<void(LogLevel, std::string_view)>;

/// Replaces the hook (default: standard error). Call before threads are started.
void setLogHook(LogHook hook);
/// May be called from any thread.
void log(LogLevel level, std::string_view message);

}  // namespace ps
