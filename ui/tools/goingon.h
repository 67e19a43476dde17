// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/simulation/snapshot.h"
#include "core/sketch/stroke.h"
#include "ui/tools/brushsettings.h"

#include <optional>
#include <string>

namespace ps {

class Document;

/// A sketched body that a stroke goes on with.
struct GoingOn {
  const Body* body = nullptr;  ///< of the document
  int palette = 0;             ///< of its matter; as many as it has entries: it has none of that yet
  RigidMove way{};             ///< from where the document has it to where it stands
};

/// What a stroke goes on with that begins at a place of the scene: the nearest of the sketched bodies that have matter
/// within `reach` m of it along each axis and take more of a material as the brush asks; nothing where there is none.
/// After the start a body is where its solid matter there is (standingNear()); what is not solid there goes on as long
/// as it lies where the document has it. One that has moved takes no copies by symmetry, which would be about another
/// place of it.
std::optional<GoingOn> goingOnAt(const Document& document, const Snapshot& now, const Vector3& place,
                                 const Vector3& reach, const std::string& material, const BrushSettings& brush,
                                 const StrokeSetup& setup);

}  // namespace ps
