// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <set>
#include <string>

namespace ps {

/// The name, or where it is taken "Ball 2", "Ball 3", whichever is the first that is free.
std::string freeName(const std::string& wanted, const std::set<std::string>& taken);

}  // namespace ps
