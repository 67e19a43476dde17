// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>

namespace ps {

/// Ends the process when it has not ended by itself within `patience`: the engine's thread may stand in a plugin that
/// never returns, and nothing can end that thread alone. Called when everything worth keeping has been kept. Says which
/// plugin it is on standard error and puts it into quarantine; the exit status is then 3.
void quitWithin(std::chrono::milliseconds patience);

}  // namespace ps
