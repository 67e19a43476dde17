// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <string>
#include <vector>

namespace ps {

class PluginRegistry;

struct TrackFinding {
  enum class Weight {
    Refused,  ///< the file is wrong
    Mended,   ///< the scene says otherwise; an editor may mend the one or the other
    Told      ///< all goes on
  };
  Weight weight = Weight::Refused;
  std::string pointer;  ///< behind the track's own: "/keys/2/value"
  std::string what;
};
/// What is wrong with a track of a project, the first of it.
std::vector<TrackFinding> findingsOf(const Project& project, const Track& track, const PluginRegistry& plugins);

}  // namespace ps
