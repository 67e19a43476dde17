// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/particlefield.h"

#include <string>
#include <utility>

namespace ps {

/// Range of the colour map, automatic until somebody sets it. An automatic one does not twitch: it shrinks only when
/// what is there fills less than half of it. SI units.
class LegendRange {
 public:
  /// `wanted`: of what is there, between round numbers, as colourRange() says.
  std::pair<double, double> update(const ParticleField& field, std::pair<double, double> wanted);
  /// Moves one end of the range in force by a share of its width, to a round value; it stays on its side of the other.
  void moveEnd(bool upper, double share);
  /// As somebody had set it; one without width is ignored.
  void set(const ParticleField& field, std::pair<double, double> range);
  std::pair<double, double> range() const { return m_range; }
  bool isSet() const { return m_set; }
  void reset() { m_valid = m_set = false; }  ///< automatic again, from nothing

 private:
  bool m_valid = false, m_set = false;
  std::string m_name;  ///< of the field
  bool m_kelvin = false;
  std::pair<double, double> m_range{0, 0};
};

}  // namespace ps
