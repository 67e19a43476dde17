// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/pieces.h"

#include <phasesketch/parameter.h>

#include <string>
#include <vector>

namespace ps {

/// A property over temperature: a constant, a curve (through points as each says, see core/math/pieces.h; constant
/// beyond the ends), or a named law. Plain value; equal responses compare equal.
struct Response {
  enum class Kind { Constant, Curve, Law };
  Kind kind = Kind::Constant;
  double constant = 0;
  std::vector<CurvePoint> points;    ///< K, unit; ascending in x
  std::string law;                   ///< see lawNames()
  std::vector<double> coefficients;  ///< as lawHelp(law) says

  Response() = default;
  Response(double value) : constant(value) {}  // NOLINT: a number is a response
  explicit Response(const api::ResponseSpec& spec);

  /// Value at a temperature in K; 0 for a response with a problem().
  double at(double kelvin) const;
  /// Where stated slopes lead a curve between its points to a least or greatest value, and to which.
  std::vector<CurvePoint> turns() const;
  /// Everywhere `factor` times as much, a factor above 0: of a law too.
  Response scaled(double factor) const;
  /// "" when well formed, else what is wrong ("points must ascend in x", "unknown law 'vogle'").
  std::string problem() const;
  bool operator==(const Response& other) const;
};

/// "linear" (a, b, T_ref): a + b (T - T_ref); "exponential" (a, T_ref, dT): a exp(-(T - T_ref)/dT);
/// "arrhenius" (a, Ea, T_ref): a exp(Ea/R (1/T - 1/T_ref)); "vogel" (A, B, T0): 10^(A + B/(T - T0));
/// "thesis_sigmoid" (a, T_ref, dT): 2a/(1 + exp((T - T_ref)/dT)).
const std::vector<std::string>& lawNames();
size_t lawCoefficientCount(const std::string& law);  ///< 0 for an unknown law
/// The formula with the meaning and unit of each coefficient; "" for an unknown law.
std::string lawHelp(const std::string& law);

/// A response baked on a uniform grid, read by linear interpolation, clamped at the ends. A step becomes as wide as the
/// grid is.
class ResponseTable {
 public:
  ResponseTable() = default;
  ResponseTable(const Response& response, double firstKelvin, double lastKelvin, size_t samples = 512);
  /// From values already sampled at `samples` uniform temperatures.
  ResponseTable(std::vector<double> values, double firstKelvin, double lastKelvin);
  double at(double kelvin) const;
  /// Integral from the first temperature to `kelvin`, exact for the interpolant; extended by the end values.
  double integral(double kelvin) const;

 private:
  std::vector<double> m_values, m_integrals;
  double m_first = 0, m_step = 1, m_inverseStep = 1;
};

}  // namespace ps
