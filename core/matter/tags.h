// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ps {

// Words by which people find a material: "food", "building".
inline constexpr size_t kMostTags = 12, kLongestTag = 24;  ///< of one material; letters

struct TagProblem {
  size_t index = 0;
  std::string what;
};
/// The first thing wrong with a list of them in UTF-8: too many, one without letters or too long, with commas, control
/// characters or spaces around it, or the same twice whatever the case of its Latin letters.
std::optional<TagProblem> problemOfTags(const std::vector<std::string>& tags);

}  // namespace ps
