// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/experiments/run.h"

#include <memory>
#include <string>
#include <vector>

// A project is run as it is, and again with one slider after the other moved to an end of its range while it runs.
namespace ps {

class PluginRegistry;

struct SliderChange {
  Address address;
  Value value;
  std::string text() const;  ///< "solver/substeps = 20"
};

/// What a run with a change, or without one, came to.
struct SoakVerdict {
  const SliderChange* change = nullptr;  ///< nullptr: the project as it is
  bool ran = false;
  bool failed = false;
  double topSpeed = 0;      ///< m/s, since the change
  double milliseconds = 0;  ///< mean of a frame
  std::string words;        ///< "fine", "FAILED: nan: ...", "refused: ..."
};
using SoakVisitor = std::function<void(const SoakVerdict&)>;

/// Both ends of every slider, the other state of every toggle, the other choices, in the order of the outliner; without
/// what is only seen and what acts on no run. `only`: beginnings of addresses, none for all.
std::vector<SliderChange> sliderChanges(const Project& project, const PluginRegistry& plugins,
                                        const std::vector<std::string>& only);

/// Runs the project from its start, then each change, for `seconds` of mechanical time. A change that has altered no
/// bit after a quarter of it is not used by the scene and ends there. A flag fails a run unless its slider asks for it;
/// a NaN, a plugin's fault and an open balance are never asked for. `plugins` is made anew after a plugin was put
/// aside. Throws Error when `stop` ended it.
void soakProject(Project project, std::unique_ptr<PluginRegistry>& plugins, const std::vector<SliderChange>& changes,
                 double seconds, const StopTest& stop, const SoakVisitor& each);

}  // namespace ps
