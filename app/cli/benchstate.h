// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/engine.h"

#include <nlohmann/json_fwd.hpp>

namespace ps::cli {

/// What the state of an engine costs: bytes for each particle, ms to save it and to restore it on one thread, and ms a
/// frame, with its share of one that takes `frameMilliseconds`, for being ready to take a failed frame back.
nlohmann::json measureState(Engine& engine, double frameMilliseconds);

}  // namespace ps::cli
