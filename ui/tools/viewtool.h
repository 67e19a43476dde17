// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

#include <string>

namespace ps {

enum class ViewTool { Select, Brush, Erase, Tap, Drain };
inline bool draws(ViewTool tool) { return tool == ViewTool::Brush || tool == ViewTool::Erase; }
/// Puts an emitter or a sink.
inline bool places(ViewTool tool) { return tool == ViewTool::Tap || tool == ViewTool::Drain; }

/// How the brush draws; shared by the viewport, its bar and the brush panel.
struct BrushSettings {
  std::string shape = "sphere";  ///< id of the brush plugin
  double radius = 0.05;          ///< m
  std::string material;          ///< SceneMaterial::id; "" takes the scene's first
  double temperature = 293.15;   ///< K
  bool operator==(const BrushSettings&) const = default;
};

inline constexpr double kBrushMinimum = 0.005, kBrushMaximum = 0.5;  ///< m
/// One step of [ and ]: about 12 %.
double largerBrush(double radius);
double smallerBrush(double radius);
/// "50 mm": lengths as the viewport writes them.
QString lengthText(double metres);

}  // namespace ps
