// SPDX-License-Identifier: Apache-2.0
#include "core/base/nearest.h"

#include <algorithm>
#include <numeric>

namespace ps {
namespace {

size_t distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0]++;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr size_t kLongest = 64;  // of what anybody types
  size_t least = word.size() / 3 + 1;
  std::string best;
  for (const std::string& candidate : candidates) {
    if (word.size() > kLongest || candidate.size() > kLongest) continue;
    const size_t steps = distance(word, candidate);
    if (steps < least) least = steps, best = candidate;
  }
  return best;
}

std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string meant = nearest(word, candidates);
  return meant.empty() ? meant : " (did you mean '" + meant + "'?)";
}

std::string mustBeOneOf(std::string_view word, const std::vector<std::string>& candidates) {
  std::string all;
  for (const std::string& one : candidates) all += (all.empty() ? "" : ", ") + one;
  return "must be one of " + all + ", not '" + std::string(word) + "'" + didYouMean(word, candidates);
}

}  // namespace ps
