// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/plane.h"
#include "core/scene/project.h"

#include <optional>
#include <utility>
#include <vector>

namespace ps {

/// A plane that opens the scene: what lies below it is neither drawn nor picked.
struct Section {
  Plane plane;
  bool shows(const Vector3& p) const { return plane.heightOf(p) >= 0; }
  bool operator==(const Section& other) const {
    return plane.normal == other.plane.normal && plane.offset == other.plane.offset;
  }
};

/// Out of the side that is cut away, as a unit vector: along the axis that it cuts across, or towards who looks along
/// `forward`; the other way round where it is flipped.
Vector3 openSide(const ViewSection& section, const Vector3& forward);
/// For somebody who looks along `forward`, a unit vector.
Section sectionFor(const ViewSection& section, const Vector3& forward);
/// What is left of lines.
using LineList = std::vector<std::pair<Vector3, Vector3>>;
LineList leftOf(const LineList& lines, const std::optional<Section>& section);

}  // namespace ps
