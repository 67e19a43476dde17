// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace ps {

/// What a project says of itself.
struct ProjectAbout {
  std::string title, description;
  std::string toTry;      ///< a sentence
  double duration = 60;   ///< s, that a run is planned to last
  std::string thumbnail;  ///< as Project::thumbnail has it; "": none of its own
  bool operator==(const ProjectAbout&) const = default;
};

}  // namespace ps
