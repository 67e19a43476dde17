// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "ui/tools/becoming.h"

#include <QtCore/QString>

#include <array>
#include <map>
#include <string>

namespace ps {

/// What a stroke is drawn on.
enum class DrawOn {
  Surface,  ///< what is under the pointer: matter, the floor, else a plane that faces the view
  Level,    ///< a level plane
  AcrossX,  ///< an upright plane
  AcrossZ,
  View,   ///< the plane through what the view looks at, across the way one looks
  Plane,  ///< a plane at any pose: FreePlane
};
inline constexpr std::array kDrawOnNames{"surface", "level", "across_x", "across_z", "view", "plane"};

/// A plane at any pose.
struct FreePlane {
  Vector3 point{0, 0, 0};  ///< m, where its grid has its middle
  double tilt = 0;         ///< rad, from level; pi is level again, seen from below
  double heading = 0;      ///< rad, about the upright axis: towards where it leans, from the front to the right
  bool operator==(const FreePlane&) const = default;
  Vector3 normal() const;  ///< of unit length
  /// The one through a point across a normal, of any length but zero.
  static FreePlane across(const Vector3& point, const Vector3& normal);
};

/// What the places of a stroke snap to.
enum class SnapTo {
  Nothing,
  Grid,     ///< crossings of the drawing plane's grid
  Strokes,  ///< the way of an earlier stroke, its ends first
  Ends,     ///< both ends of an earlier stroke
};
inline constexpr std::array kSnapToNames{"none", "grid", "strokes", "ends"};

/// How the brush draws; shared by all views and the brush panel.
struct BrushSettings {
  std::string shape;                       ///< id of the brush plugin; "" until plugins are there
  double radius = 0.05;                    ///< m
  std::string material;                    ///< SceneMaterial::id; "" takes the scene's first
  double temperature = 293.15;             ///< K
  std::string becomes = kBecomesOfItself;  ///< what bodies that are begun become, of kBecomings
  bool joins = false;                      ///< bodies go on with matter that they have none of yet
  bool held = false;                       ///< what is drawn stands still until it is let go
  DrawOn drawOn = DrawOn::Surface;
  double planeAt = 0;  ///< m, height of the level plane, or place of an upright one along its normal
  FreePlane plane;
  SnapTo snapTo = SnapTo::Nothing;
  double snapWithin = 0.03;  ///< m, how near to a stroke the pointer has to come
  double grid = 0;           ///< m, from line to line; 0: as wide as suits the scene
  double steady = 0;  ///< m, by which the brush trails behind the pointer, so that the hand's tremor does not show
  VoxelShape::Symmetry symmetry;
  /// Of each brush by its id: its own parameters that differ from their defaults.
  std::map<std::string, ParameterSet> parameters;
  bool operator==(const BrushSettings&) const = default;
  /// Those of the chosen brush.
  ParameterSet shapeParameters() const;
};

/// What every brush has: its size, what it draws, on what, and what is drawn along with it.
api::ParameterList brushParameters();
ParameterSet valuesOf(const BrushSettings& brush);
/// Sets one of them; a key that is none is ignored.
void setValueOf(BrushSettings& brush, const std::string& key, const Value& value);

inline constexpr double kBrushMinimum = 0.005, kBrushMaximum = 0.5;  ///< m
/// One step of [ and ]: twenty of them are a factor of ten.
inline constexpr double kBrushStep = 1.122018454301963;
/// "50 mm": lengths as the viewport writes them.
QString lengthText(double metres);

}  // namespace ps
