// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/sketch/drawingplane.h"
#include "ui/render/renderer.h"
#include "ui/tools/brushsettings.h"
#include "ui/tools/tool.h"

#include <optional>
#include <vector>

// What helps a hand to draw: planes in the air, mirrors and axes, straight lines, and a brush that trails behind.
namespace ps {

/// The plane that the settings ask for, its normal towards the viewer; nothing where strokes are drawn on surfaces.
std::optional<DrawingPlane> planeFor(const BrushSettings& brush, const Pointer& pointer);

/// Grid of the plane, outline of the mirror and the axis of copies, within the scene's bounds.
std::vector<GuideLine> guideLines(const BrushSettings& brush, const Environment& environment);

/// Keeps a stroke on a straight line from where it was asked for, along one of eight directions of its plane.
class Straightener {
 public:
  /// The place to draw at for the pointer's place on the plane. `spacing`: m; the direction is chosen two of them away.
  Vector3 place(const Vector3& pointer, const DrawingPlane& plane, double spacing);
  void start(const Vector3& from) { m_from = from, m_along.reset(); }
  void stop() { m_from.reset(); }
  bool active() const { return m_from.has_value(); }

 private:
  std::optional<Vector3> m_from;   ///< m
  std::optional<Vector3> m_along;  ///< unit; nothing as long as the way is too short to tell
};

/// A place that is drawn behind the pointer on a line of fixed length ("lazy brush"): it moves only when the line is
/// taut, and along it.
class Trailing {
 public:
  void start(const Vector3& at) { m_at = at; }
  Vector3 follow(const Vector3& pointer, double length);

 private:
  Vector3 m_at{0, 0, 0};  ///< m
};

}  // namespace ps
