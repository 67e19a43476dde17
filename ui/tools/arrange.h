// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/pose.h"
#include "ui/document/placement.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ps {

struct Snapshot;

/// Where things are against each other: pure functions, of values. Matter of bodies counts where it is by now.

/// Around the matter of bodies as it stands, by Body::id; those that have none stand as the document has them.
using MatterBoxes = std::map<std::string, BodyBounds>;

/// Those of a scene as a view shows it.
MatterBoxes matterBoxesOf(const Snapshot* scene);

/// Around all of them; nothing around what has no extent, as walls.
std::optional<BodyBounds> boundsOf(const Placement& things, const MatterBoxes& matter);
/// The shortest way along an axis of the scene by which copies of things come to stand in free room, a layer of air
/// beside everything that is there. Nothing where the room has no place for them.
std::optional<Vector3> wayToFreeRoom(const Project& project, const Placement& things, const MatterBoxes& matter);

/// Whether one of them would stand in something that is there.
bool overlapsAny(const Project& project, const Placement& things, const MatterBoxes& matter);

/// Around the bodies of a scene that are none of some things.
std::vector<BodyBounds> bodiesBeside(const Project& project, const Placement& things, const MatterBoxes& matter);
/// m, the highest top of those over or under which a box stands, and of the floor.
double heightUnder(const BodyBounds& box, const std::vector<BodyBounds>& bodies, double floor);

enum class Side { Least, Middle, Greatest };
/// Things with their sides, or middles, at one place along an axis (0 x, 1 y, 2 z): that of all of them together. Walls
/// take part with the place that they have, as they have no sides.
Placement aligned(Placement things, const MatterBoxes& matter, int axis, Side side);
/// With equal gaps between them along an axis, the first and the last staying where they are.
Placement distributed(Placement things, const MatterBoxes& matter, int axis);
/// Each let down onto what is below it: the floor, or another body, which may have fallen too. Walls stay.
Placement dropped(const Project& project, Placement things, const MatterBoxes& matter);

/// Whether any of some things stands elsewhere than before, or is turned. Both hold the same ones, in the same order.
bool standElsewhere(const Placement& before, const Placement& now);
/// Things once more as far on, and as far turned, as they are from where they were before: each by its own move.
Placement continued(const Placement& before, Placement now);

}  // namespace ps
