// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "ui/render/renderer.h"

#include <utility>

namespace ps {

/// Automatic range of the colour map that does not twitch: ends lie on round numbers, and the range shrinks only when
/// what is there fills less than half of it. SI units.
class LegendRange {
 public:
  std::pair<double, double> update(ColourBy colour, std::pair<double, double> measured);
  void reset() { m_valid = false; }

 private:
  bool m_valid = false;
  ColourBy m_colour = ColourBy::Material;
  std::pair<double, double> m_range{0, 0};
};

}  // namespace ps
