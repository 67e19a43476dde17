// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/parameters/parameterset.h"

#include <QtCore/QString>

#include <map>
#include <string>

namespace ps {

/// How the brush draws; shared by all views and the brush panel.
struct BrushSettings {
  std::string shape;            ///< id of the brush plugin; "" until plugins are there
  double radius = 0.05;         ///< m
  std::string material;         ///< SceneMaterial::id; "" takes the scene's first
  double temperature = 293.15;  ///< K
  /// Of each brush by its id: its own parameters that differ from their defaults.
  std::map<std::string, ParameterSet> parameters;
  bool operator==(const BrushSettings&) const = default;
  /// Those of the chosen brush.
  ParameterSet shapeParameters() const;
};

inline constexpr double kBrushMinimum = 0.005, kBrushMaximum = 0.5;  ///< m
/// One step of [ and ]: about 12 %.
double largerBrush(double radius);
double smallerBrush(double radius);
/// "50 mm": lengths as the viewport writes them.
QString lengthText(double metres);

}  // namespace ps
