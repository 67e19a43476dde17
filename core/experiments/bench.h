// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <nlohmann/json.hpp>
#include <string>

namespace ps {

class PluginRegistry;

struct BenchScene {
  nlohmann::json result;  ///< a row of bench's report
  double densityNanosecondsPerPair = 0;
};
/// Steps a scene as simulate does, `frames` times after a warm-up. Throws Error when the run sets a flag, InputError
/// when there is nothing to measure.
BenchScene benchScene(const std::string& name, const Project& project, PluginRegistry& plugins, long frames);
/// A slider dragged over the tank, beside the same tank left alone: a row of bench's report.
nlohmann::json benchDrag(int particles, PluginRegistry& plugins, long frames);

/// What strokes and hands cost the engine's thread in the tank (see measureSketch()): a row of bench's report; its ms
/// are those of the kind of edit that comes nearest to its limit.
nlohmann::json benchSketch(int particles, PluginRegistry& plugins, long frames);

nlohmann::json benchMachine();
/// What the machine can do, so that figures of two machines may be compared.
nlohmann::json benchCalibration(PluginRegistry& plugins);

}  // namespace ps
