// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/placement.h"
#include "ui/session/selection.h"

#include <optional>
#include <string>
#include <vector>

namespace ps {

/// Pins as they are copied: no things of a project, but boxes of a body. They are told from the middle of its extent,
/// so that they hold another body where they held that one.

/// Those among some items, m.
std::vector<Region> pinsOf(const Project& project, const std::vector<SelectedItem>& items);
/// As the clipboard has them.
std::string textOfPins(const std::vector<Region>& pins);
/// Nothing where a text is none of that kind.
std::optional<std::vector<Region>> pinsIn(const std::string& text);
/// A body with more pins, behind those that it has. What would stand in one of those comes to stand beside it.
BodyPins withPins(const Body& body, const std::vector<Region>& pins);
/// Bodies without those of their pins that are among some items.
std::vector<BodyPins> withoutPins(const Project& project, const std::vector<SelectedItem>& items);
/// Where a body is held unless somebody says where, from the middle of its extent: by its topmost two layers; what lies
/// flat by those at its low end along x.
Region firstPin(const Body& body, double spacing);

}  // namespace ps
