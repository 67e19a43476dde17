// SPDX-License-Identifier: Apache-2.0
#include "ui/document/freename.h"

namespace ps {

std::string freeName(const std::string& wanted, const std::set<std::string>& taken) {
  if (!taken.contains(wanted)) return wanted;
  const size_t end = wanted.find_last_not_of("0123456789");
  const bool counted = end != std::string::npos && end > 0 && end + 1 < wanted.size() && wanted[end] == ' ';
  const std::string base = (counted ? wanted.substr(0, end) : wanted) + ' ';
  int number = 2;
  while (taken.contains(base + std::to_string(number))) ++number;
  return base + std::to_string(number);
}

}  // namespace ps
