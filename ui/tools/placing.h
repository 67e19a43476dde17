// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/document/placement.h"
#include "ui/session/handlesettings.h"
#include "ui/session/selection.h"
#include "ui/tools/tool.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ps {

/// Where matter of a body is by now, on the average, in m, by Body::id.
using MatterPlaces = std::map<std::string, Vector3>;
/// Of some bodies, as a view shows them; bodies without matter there have none.
MatterPlaces matterOf(const Snapshot* scene, const std::vector<std::string>& bodies);

/// Things that can be dragged by the handles of one kind, and where they are: their matter, where there is some.
struct Placeable {
  std::vector<std::pair<SelectedItem, Vector3>> items;  ///< m
  Matrix3 axes = Matrix3::Identity();                   ///< of the handles
  bool along = true;                                    ///< they can be stretched along those one by one
  QString note;                                         ///< "" or what among the selected cannot be dragged, and why
  Vector3 middle() const;
  /// m, where the handles stand. What is moved stands nowhere else than it is: for that the origin is the middle.
  Vector3 centre(Gizmo::Kind kind, Pivot pivot) const;
};
Placeable placeable(const Document& document, const std::vector<SelectedItem>& selected, Gizmo::Kind kind,
                    const MatterPlaces& matter);
/// Those of them as they stand in the document.
Placement placementOf(const Document& document, const Placeable& placeable);

// What a drag makes of what stood there when it began.
Placement shifted(Placement things, const Vector3& way);
/// About `pivot` (m), or each about its own middle; bodies go with their matter.
Placement turned(Placement things, const MatterPlaces& matter, const std::optional<Vector3>& pivot,
                 const Quaternion& turn);
/// Each by itself along its own axes; places go to or from the pivot by the same factors along `axes`.
struct PlaceStretch {
  std::optional<Vector3> pivot{};  ///< m; none: things stay where they are
  Matrix3 axes = Matrix3::Identity();
};
Placement stretched(Placement things, const Vector3& factors, const MatterPlaces& matter = {},
                    const PlaceStretch& places = {});

}  // namespace ps
