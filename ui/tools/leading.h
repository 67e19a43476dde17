// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/simulation/snapshot.h"
#include "ui/document/document.h"

// What takes a body in hand and leads it: one that is held in place, a spoon, a rod.
namespace ps {

/// The body that a particle of the scene belongs to, where a hand may lead it; nullptr: it may not.
const Body* leadable(const Document& document, const Snapshot& scene, size_t particle);
/// The body goes by a move from where it stood `before`, as far as it stays within the room of the scene; returns by
/// how many m that is less. While time passes matter meets it on its way. Within a gesture it is one step of undo.
Vector3 lead(Document& document, const Body& before, RigidMove move);

}  // namespace ps
