// SPDX-License-Identifier: Apache-2.0
#include "ui/viewport/legendrange.h"

#include "ui/theme/units.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// The next of 1, 2, 5 times a power of ten.
double roundUp(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(std::max(value, 1e-9))));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (decade * factor >= value * (1 - 1e-9)) return decade * factor;
  }
  return decade * 10;
}

}  // namespace

void LegendRange::moveEnd(bool upper, double share) {
  if (!m_valid) return;
  const double width = m_range.second - m_range.first;
  // Temperatures are round in the unit in which they are shown.
  const double degrees = m_kelvin ? degreesPerKelvin() : 1, zero = m_kelvin ? kelvinOf(0) : 0;
  const double step = roundUp(width * degrees / 200) / degrees;
  double& end = upper ? m_range.second : m_range.first;
  end = zero + step * std::round((end + share * width - zero) / step);
  if (upper)
    end = std::max(end, m_range.first + 5 * step);
  else
    end = std::min(end, m_range.second - 5 * step);
  m_set = true;
}

void LegendRange::set(const ParticleField& field, std::pair<double, double> range) {
  if (!(range.second > range.first)) return;
  m_valid = m_set = true;
  m_name = field.name;
  m_kelvin = field.unit == "K";
  m_range = range;
}

std::pair<double, double> LegendRange::update(const ParticleField& field, std::pair<double, double> wanted) {
  const bool same = field.name == m_name;
  if (m_set && same) return m_range;
  m_set = false;
  const bool fits = m_valid && same && wanted.first >= m_range.first && wanted.second <= m_range.second;
  if (!fits || wanted.second - wanted.first < 0.5 * (m_range.second - m_range.first)) m_range = wanted;
  m_valid = true;
  m_name = field.name;
  m_kelvin = field.unit == "K";
  return m_range;
}

}  // namespace ps
