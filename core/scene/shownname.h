// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace ps {

/// What an item of the scene (body, wall, tap, drain, probe) is called where people read it: a file may leave its name
/// out, but not its id.
const std::string& shownName(const auto& item) { return item.name.empty() ? item.id : item.name; }
/// Likewise of a material, which has a label.
const std::string& shownName(const auto& material) requires requires { material.label; }
{ return material.label.empty() ? material.id : material.label; }

}  // namespace ps
