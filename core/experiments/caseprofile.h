// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace ps {

class Engine;

/// Where every particle stands and how warm it is at the end of a run, fixed ones too.
struct TemperatureField {
  struct Point {
    std::array<double, 3> place{};  ///< m
    double temperature = 0;         ///< K
  };
  std::vector<Point> points;
  double thermalTime = 0, spacing = 0;  ///< s, m
};
TemperatureField temperatureField(Engine& engine);

/// A law of temperature along an axis, and what of the field is compared with it.
struct ProfileCheck {
  std::string law;                ///< see profileLaws(); "" for none
  std::vector<double> arguments;  ///< of the law
  std::string measure;            ///< see profileMeasures()
  size_t axis = 0;
  double from = -std::numeric_limits<double>::infinity(), to = -from;  ///< m along the axis: what stands between them
};

/// half_spaces: place of the contact in m; K at first on this side and beyond; W/(m K) and J/(m3 K) of this side, then
///   of the other. After t thermal seconds T = Tc + (T_side - Tc) erf(|x|/(2 sqrt(a t))) with a = k/(rho c) of the side
///   and Tc weighted with sqrt(k rho c) (Carslaw & Jaeger 1959): bodies so long that the far ends do not know yet.
/// line: a place in m and its temperature in K, another place and its temperature: two walls, long after the start.
std::vector<std::string> profileLaws();
/// l2, linf: root of the mean square, and the largest, difference from the law over its difference of temperatures.
///
/// contact: K, mean of the particles within a spacing of the contact, those of each side weighted with its
/// conductivity.
///
/// slip: spacings by which the two walls of a line seem to stand back: a straight line through what stands two spacings
/// off them and farther, carried on to their temperatures; the larger of the two.
std::vector<std::string> profileMeasures();
/// NaN where no particle is in the range. Throws InputError when the law takes other arguments.
double profileValue(const TemperatureField& field, const ProfileCheck& check);

}  // namespace ps
