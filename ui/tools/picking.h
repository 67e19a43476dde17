// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/session/selection.h"
#include "ui/tools/tool.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ps {

/// What can be picked that has no matter: walls, boxes of probes, and pins of bodies that are selected. Pure: no
/// picture, no document.

using Lines = std::vector<std::pair<Vector3, Vector3>>;

/// Whether hands may take something of the scene.
bool canPick(const auto& thing) { return thing.visible && !thing.locked; }

/// The edges of a wall as it is seen, m; none where nothing of it is. `whole`: those of a sphere behind planes too.
Lines wallLines(const Environment& environment, size_t wall, bool whole = false);
/// Those that a section leaves of it.
Lines seenLines(const Environment& environment, size_t wall, const std::optional<Section>& section);
Lines boxLines(const Region& box);

/// Something that lies under a pointer.
struct Pick {
  SelectedItem item;
  bool byLine = false;  ///< at one of its edges, not on its face
};
/// Pins first, then boxes of probes (on matter only just at their edges), then edges of walls as far as they are drawn
/// and no matter hides them there, then floors and lids by the face that one sees; whoever points at matter means that.
/// Sides are looked through, as they are drawn, and so is what is hidden or locked and what a section cuts away.
std::optional<Pick> pickAt(const Project& project, const std::vector<SelectedItem>& selected, const Pointer& pointer);
/// The pins of bodies that are selected, or of which one is.
std::vector<SelectedItem> shownPins(const Project& project, const std::vector<SelectedItem>& selected);

}  // namespace ps
