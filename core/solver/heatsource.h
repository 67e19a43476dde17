// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/thermal.h>

#include <string>
#include <vector>

namespace ps {

/// A plugin that warms or cools matter, whatever the thermal model.
struct HeatSource {
  const api::HeatSourcePlugin* plugin = nullptr;
  std::string name;  ///< its id, for messages
  std::vector<double> parameters;
};

}  // namespace ps
