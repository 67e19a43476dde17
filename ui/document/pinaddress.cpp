// SPDX-License-Identifier: Apache-2.0
#include "ui/document/pinaddress.h"

#include <algorithm>
#include <charconv>

namespace ps {

std::optional<PinAddress> PinAddress::parse(const std::string& text) {
  const size_t slash = text.rfind('/');
  if (slash == std::string::npos) return std::nullopt;
  PinAddress address{text.substr(0, slash), 0};
  const char* end = text.data() + text.size();
  const auto [last, problem] = std::from_chars(text.data() + slash + 1, end, address.index);
  if (problem != std::errc() || last != end) return std::nullopt;
  return address;
}

const Region* findPin(const Project& project, const std::string& address) {
  const auto pin = PinAddress::parse(address);
  if (!pin) return nullptr;
  const auto body = std::find_if(project.bodies.begin(), project.bodies.end(),
                                 [&](const Body& each) { return each.id == pin->body; });
  return body != project.bodies.end() && pin->index < body->pins.size() ? &body->pins[pin->index] : nullptr;
}

}  // namespace ps
