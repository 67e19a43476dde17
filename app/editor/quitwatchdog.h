// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>

namespace ps {

/// Ends the process when it has not ended by itself within `patience`: the engine's thread may stand in a plugin that
/// never returns, and nothing can end that thread alone. Called when everything worth keeping has been kept. A plugin
/// that has not come back for half of that is named on standard error and put into quarantine; the exit status is
/// then 3.
void quitWithin(std::chrono::milliseconds patience);

}  // namespace ps
