// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>
#include <vector>

namespace ps {

/// What probes measure is too much for one list: the headings under which menus have it, the most used first.
const std::vector<std::string_view>& quantityGroups();
/// The heading of one, by the name that probes have of it; what plugins declare comes under the last.
std::string_view quantityGroup(std::string_view quantity);

}  // namespace ps
