// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace ps {

/// The candidate that `word` may be a slip for: at most a third of its letters put in, left out or changed
/// (Levenshtein's distance). The first of several; "" where there is none.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);
/// " (did you mean 'environment'?)", or "".
std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates);
/// "must be one of a, b, not 'c'", with didYouMean() behind it.
std::string mustBeOneOf(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace ps
