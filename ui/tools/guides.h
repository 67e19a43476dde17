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

/// m, from line to line of the grid on drawing planes.
double gridStep(const BrushSettings& brush, const Environment& environment);
/// The crossing of a plane's grid that is nearest to a place, moved along the plane alone.
Vector3 onGrid(const BrushSettings& brush, const Environment& environment, const DrawingPlane& plane,
               const Vector3& place);

/// Where a stroke snaps to that is drawn already.
struct StrokeSnap {
  Vector3 place{0, 0, 0};  ///< m
  bool end = false;        ///< it is one of the stroke's ends
};
/// What is nearest to the pointer's ray of the ways of a project's strokes, where the document has them, their copies
/// included: ends within the reach of the settings first, then, unless only these are asked for, all of the way. Not of
/// strokes that erase or are hidden, nor of hidden bodies.
std::optional<StrokeSnap> strokeSnap(const BrushSettings& brush, const Project& project, const Ray& ray);

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
