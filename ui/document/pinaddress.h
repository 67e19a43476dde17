// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"

#include <optional>
#include <string>

namespace ps {

/// A pin has no id of its own: it is named by its body and its place among that one's pins, "rope/0".
struct PinAddress {
  std::string body;  ///< Body::id
  size_t index = 0;  ///< in Body::pins
  std::string text() const { return body + "/" + std::to_string(index); }
  static std::optional<PinAddress> parse(const std::string& text);
};

/// A pin of a project by what PinAddress::text() gives; nullptr where there is none.
const Region* findPin(const Project& project, const std::string& address);

}  // namespace ps
