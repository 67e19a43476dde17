// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace ps::cli {

/// Tries a plugin in a child process and prints one line about it. kFine, or kFailed when something is wrong with it,
/// or crashes; kNoReturn when it takes longer than `patience`, in s. Call it before any thread is started.
int tryPlugin(const std::string& path, double patience);

}  // namespace ps::cli
