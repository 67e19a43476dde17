// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <QtCore/QString>

#include <vector>

namespace ps {

class PluginRegistry;
struct BrushSettings;

/// What of a brush particles are too large for.
struct Coarseness {
  QString row;   ///< of the brush's parameter that is small, as valuesOf() and the brush's declarations have it
  bool own;      ///< it is one of the latter
  QString text;  ///< "The brush is 2.4 particles wide, which stand 20 mm apart: small shapes come out coarse."
};
/// Of what it draws where particles stand `spacing` m apart: it is narrower than three of them, or its walls are of
/// one.
std::vector<Coarseness> coarsenessOf(const BrushSettings& brush, const PluginRegistry& plugins, double spacing);

}  // namespace ps
