// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace ps {

/// What a project says of itself.
struct ProjectAbout {
  std::string title, description;
  std::string toTry;  ///< a sentence
  bool operator==(const ProjectAbout&) const = default;
};

}  // namespace ps
