// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"

#include <string>

namespace ps::render {

using Colour = std::array<float, 3>;  ///< sRGB 0..1

/// Colours of the scene's furniture by theme and name, from resources/theme/maps.json. Throws Error for unknown names.
Colour sceneColour(bool dark, const std::string& name);

/// What classes of a map are told apart by without their colours; the shaders know the same numbers.
enum class Pattern { Plain, Stripes, Dots, Checks };
/// Of a class, by its value; plain where the map has none.
Pattern patternOf(const std::string& colour, float value);

/// 1024 samples of a colour map over a range of values, for colouring many particles.
class ColourTable {
 public:
  /// `minimum` and `maximum` in the unit of the quantity (K, phase 0..4, m/s, fraction); `meltingPoint` in K.
  ColourTable(const std::string& colour, double minimum, double maximum, double meltingPoint);
  const Colour& at(float value) const;

 private:
  std::array<Colour, 1024> m_samples{};
  float m_minimum, m_scale;
};

}  // namespace ps::render
