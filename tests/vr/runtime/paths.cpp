// SPDX-License-Identifier: Apache-2.0
#include "tests/vr/runtime/paths.h"

#include "tests/vr/runtime/profiles.h"
#include "tests/vr/runtime/refusal.h"

#include <algorithm>

namespace ps::scripted {

bool isPathLevel(std::string_view text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
  };
  return std::all_of(text.begin(), text.end(), allowed) && text.find_first_not_of('.') != std::string_view::npos;
}

XrPath Paths::pathOf(std::string_view text) {
  const auto known = m_paths.find(text);
  if (known != m_paths.end()) return known->second;
  const std::string why = "\"" + std::string(text) + "\" is no path";
  require(!text.empty() && text.size() < XR_MAX_PATH_LENGTH && text[0] == '/', XR_ERROR_PATH_FORMAT_INVALID, why);
  for (size_t begin = 1; begin <= text.size();) {
    const size_t end = std::min(text.find('/', begin), text.size());
    require(isPathLevel(text.substr(begin, end - begin)), XR_ERROR_PATH_FORMAT_INVALID, why);
    begin = end + 1;
  }
  m_texts.emplace_back(text);
  return m_paths[m_texts.back()] = m_texts.size();
}

const std::string& Paths::textOf(XrPath path) const {
  require(path > 0 && path <= m_texts.size(), XR_ERROR_PATH_INVALID, "there is no path of that number");
  return m_texts[path - 1];
}

int handOf(std::string_view path) {
  for (int hand = 0; hand < 2; ++hand) {
    const std::string_view own = kHands[hand];
    if (path.starts_with(own) && (path.size() == own.size() || path[own.size()] == '/')) return hand;
  }
  return -1;
}

std::string_view componentOf(std::string_view path) { return path.substr(kHands[handOf(path)].size()); }

}  // namespace ps::scripted
