// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <openxr/openxr.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ps::scripted {

/// Numbers for paths, as xrStringToPath() gives them; XR_NULL_PATH is of none.
class Paths {
 public:
  /// Throws Refusal XR_ERROR_PATH_FORMAT_INVALID for what is no path (OpenXR specification 1.0, section 6.1).
  XrPath pathOf(std::string_view text);
  /// Throws Refusal XR_ERROR_PATH_INVALID.
  const std::string& textOf(XrPath path) const;

 private:
  std::vector<std::string> m_texts;
  std::map<std::string, XrPath, std::less<>> m_paths;
};

/// One level of a path, which names of actions and of sets are too: a to z, 0 to 9, "-", "_", ".", and no dots alone.
bool isPathLevel(std::string_view text);

/// 0 and 1 of a path that begins with the left or the right hand's, -1 of any other.
int handOf(std::string_view path);
/// "/input/trigger/value" of "/user/hand/left/input/trigger/value", which must be a hand's.
std::string_view componentOf(std::string_view path);

}  // namespace ps::scripted
