// SPDX-License-Identifier: Apache-2.0
#include "core/matter/tags.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace ps {
namespace {

std::string problemOfTag(std::string_view tag) {
  const auto letters = std::count_if(tag.begin(), tag.end(), [](char c) { return (c & 0xC0) != 0x80; });
  if (tag.empty() || static_cast<size_t>(letters) > kLongestTag)
    return "must be a word of 1 to " + std::to_string(kLongestTag) + " letters";
  const auto parts = [](char c) { return c == ',' || static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  if (tag.front() == ' ' || tag.back() == ' ' || std::any_of(tag.begin(), tag.end(), parts))
    return "must be a word without commas, line breaks and spaces around it";
  return {};
}

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::optional<TagProblem> problemOfTags(const std::vector<std::string>& tags) {
  if (tags.size() > kMostTags)
    return TagProblem{kMostTags, "is one more than the " + std::to_string(kMostTags) + " that a material may have"};
  std::set<std::string> seen;
  for (size_t i = 0; i < tags.size(); ++i) {
    if (std::string problem = problemOfTag(tags[i]); !problem.empty()) return TagProblem{i, std::move(problem)};
    if (!seen.insert(lower(tags[i])).second) return TagProblem{i, "stands here twice"};
  }
  return std::nullopt;
}

}  // namespace ps
