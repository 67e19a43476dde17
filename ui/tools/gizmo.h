// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/tools/tool.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace ps {

/// The handles of a gizmo in space, what a pointer takes hold of, and how far it has dragged it. Pure: no document, no
/// picture. It is 96 units of fineness (pixels) long at any distance.

inline constexpr double kGizmoArm = 96;
/// m, of the arms of a gizmo there, as a pointer's viewer sees it.
double armOf(const Pointer& pointer, const Vector3& centre);

/// A handle as lines, and as a face where it has one.
struct GizmoShape {
  std::vector<std::pair<Vector3, Vector3>> lines;
  std::vector<Vector3> face;
  std::optional<Vector3> tip;  ///< of an arm, where its arrow or its cube is
};
/// `arm` in m; `forward` along which one looks.
GizmoShape shapeOf(const Gizmo& gizmo, const GizmoPart& part, double arm, const Vector3& forward);
/// All handles that can be seen from there; arms that point at the viewer or away cannot.
std::vector<GizmoPart> partsOf(const Gizmo& gizmo, const Vector3& forward);
std::optional<GizmoPart> partAt(const Gizmo& gizmo, const Pointer& pointer);

/// What a drag of one handle says.
struct GizmoDrag {
  Vector3 way{0, 0, 0};      ///< m
  double amount = 0;         ///< m along an arm, radians about an axis, a factor
  Vector3 factors{1, 1, 1};  ///< along the gizmo's axes
};
/// From where a handle was pressed; angles are followed beyond half a turn, from drag to drag.
class GizmoGrip {
 public:
  GizmoGrip(const Gizmo& gizmo, const GizmoPart& part, const Pointer& pressed);
  const Gizmo& gizmo() const { return m_gizmo; }
  const GizmoPart& part() const { return m_part; }
  /// `step`: in m, radians or as a share, to whole multiples of which it goes; 0: none.
  GizmoDrag drag(const Pointer& to, double step);
  /// The same for an amount that was typed: in m, radians, or a factor.
  GizmoDrag exactly(double amount) const;
  /// Whether one amount says all of it: an arm, a ring, a factor.
  bool hasAmount() const;

 private:
  double along(const Ray& ray) const;
  std::optional<Vector3> onPlane(const Ray& ray) const;
  double raw(const Pointer& to);

  Gizmo m_gizmo;
  GizmoPart m_part;
  Pointer m_pressed;
  double m_arm = 1, m_from = 0, m_turned = 0;
  Vector3 m_last;
};

}  // namespace ps
