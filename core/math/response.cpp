// SPDX-License-Identifier: Apache-2.0
#include "core/math/response.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace ps {
namespace {

constexpr double kGasConstant = 8.314462618;  // J/(mol K)

struct Law {
  std::string name;
  size_t coefficients;
  std::string help;
};

const std::vector<Law>& laws() {
  static const std::vector<Law> list{
      {"linear", 3, "a + b (T \u2212 T_ref): a in the property's unit, b per K, T_ref in K"},
      {"exponential", 3, "a exp(\u2212(T \u2212 T_ref)/dT): a in the property's unit, T_ref and dT in K"},
      {"arrhenius", 3, "a exp(Ea/R (1/T \u2212 1/T_ref)): a in the property's unit, Ea in J/mol, T_ref in K"},
      {"vogel", 3, "10^(A + B/(T \u2212 T0)): A decimal logarithm of the property's unit, B and T0 in K"},
      {"thesis_sigmoid", 3, "2a/(1 + exp((T \u2212 T_ref)/dT)): a in the property's unit, T_ref and dT in K"},
  };
  return list;
}

const Law* findLaw(const std::string& name) {
  const auto found = std::find_if(laws().begin(), laws().end(), [&](const Law& law) { return law.name == name; });
  return found == laws().end() ? nullptr : &*found;
}

/// Rounds to 40 significant bits. exp and pow of different C libraries agree to their last bit but one; what is read
/// here reaches the state hash, which must be equal on every machine.
double withoutLastBits(double value) {
  if (!std::isfinite(value)) return value;
  constexpr uint64_t kDropped = (uint64_t{1} << 12) - 1;
  return std::bit_cast<double>((std::bit_cast<uint64_t>(value) + (kDropped >> 1) + 1) & ~kDropped);
}

/// exp that stays finite, so that a law far outside its range gives a huge number instead of an infinity.
double boundedExp(double x) { return std::exp(std::clamp(x, -600.0, 600.0)); }

double lawAt(const std::string& law, const std::vector<double>& c, double kelvin) {
  if (law == "linear") return c[0] + c[1] * (kelvin - c[2]);
  double value = 0;
  if (law == "exponential") value = c[0] * boundedExp(-(kelvin - c[1]) / c[2]);
  if (law == "arrhenius") value = c[0] * boundedExp(c[1] / kGasConstant * (1 / std::max(kelvin, 1e-3) - 1 / c[2]));
  // Below T0 a Vogel law has no meaning: it holds its value of one thousandth of B above T0, about 10^(A + 1000).
  if (law == "vogel") value = boundedExp(std::log(10.0) * (c[0] + c[1] / std::max(kelvin - c[2], 1e-3 * c[1])));
  if (law == "thesis_sigmoid") value = 2 * c[0] / (1 + boundedExp((kelvin - c[1]) / c[2]));
  return withoutLastBits(value);
}

double curveAt(const std::vector<CurvePoint>& p, double kelvin) {
  if (p.empty()) return 0;
  if (kelvin <= p.front().x) return p.front().y;
  if (kelvin >= p.back().x) return p.back().y;
  const auto above = std::upper_bound(p.begin(), p.end(), kelvin, [](double x, const auto& q) { return x < q.x; });
  return valueOn(p, static_cast<size_t>(above - p.begin()) - 1, kelvin);
}

std::string curveProblem(const std::vector<CurvePoint>& points) {
  if (points.empty()) return "a curve needs at least one point";
  for (size_t i = 0; i < points.size(); ++i) {
    const CurvePoint& p = points[i];
    for (const double number : {p.x, p.y, p.slopeBefore.value_or(0), p.slopeAfter.value_or(0)}) {
      if (!std::isfinite(number)) return "point " + std::to_string(i) + " is not a finite number";
    }
    if (i > 0 && points[i].x <= points[i - 1].x) return "points must ascend in temperature";
  }
  return {};
}

std::string lawProblem(const std::string& name, const std::vector<double>& coefficients) {
  const Law* law = findLaw(name);
  if (!law) {
    std::string names;
    for (const Law& known : laws()) names += (names.empty() ? "" : ", ") + known.name;
    return "unknown law '" + name + "'; known are " + names;
  }
  if (coefficients.size() != law->coefficients) {
    return "law '" + name + "' takes " + std::to_string(law->coefficients) + " coefficients, not " +
           std::to_string(coefficients.size());
  }
  for (const double c : coefficients) {
    if (!std::isfinite(c)) return "a coefficient of law '" + name + "' is not a finite number";
  }
  const bool divides = name == "exponential" || name == "thesis_sigmoid";
  if (divides && coefficients[2] == 0) return "dT of law '" + name + "' must not be zero";
  if (name == "arrhenius" && coefficients[2] <= 0) return "T_ref of law 'arrhenius' must be above 0 K";
  if (name == "vogel" && coefficients[1] <= 0) return "B of law 'vogel' must be above 0 K";
  return {};
}

}  // namespace

Response::Response(const api::ResponseSpec& spec) : constant(spec.constant) {
  switch (spec.kind) {
    case api::ResponseSpec::Kind::Constant:
      break;
    case api::ResponseSpec::Kind::Curve:
      kind = Kind::Curve;
      for (const api::ResponsePoint& point : spec.points) points.push_back({point.x, point.y});
      break;
    case api::ResponseSpec::Kind::Law:
      kind = Kind::Law;
      law = spec.law ? spec.law : "";
      coefficients.assign(spec.coefficients.begin(), spec.coefficients.end());
      break;
  }
}

double Response::at(double kelvin) const {
  switch (kind) {
    case Kind::Constant:
      return constant;
    case Kind::Curve:
      return curveAt(points, kelvin);
    case Kind::Law:
      return lawProblem(law, coefficients).empty() ? lawAt(law, coefficients, kelvin) : 0;
  }
  return 0;
}

std::vector<CurvePoint> Response::turns() const {
  std::vector<CurvePoint> turns;
  for (size_t piece = 0; kind == Kind::Curve && piece + 1 < points.size(); ++piece) {
    for (const double x : turnsOn(points, piece)) turns.push_back({x, valueOn(points, piece, x)});
  }
  return turns;
}

Response Response::scaled(double factor) const {
  Response result = *this;
  result.constant *= factor;
  for (CurvePoint& point : result.points) {
    point.y *= factor;
    for (std::optional<double>* slope : {&point.slopeBefore, &point.slopeAfter}) {
      if (*slope) **slope *= factor;
    }
  }
  if (kind != Kind::Law || !lawProblem(law, coefficients).empty()) return result;
  std::vector<double>& c = result.coefficients;
  if (law == "vogel") {
    c[0] += std::log10(factor);
  } else {
    c[0] *= factor;
    if (law == "linear") c[1] *= factor;
  }
  return result;
}

std::string Response::problem() const {
  switch (kind) {
    case Kind::Constant:
      return std::isfinite(constant) ? std::string() : "is not a finite number";
    case Kind::Curve:
      return curveProblem(points);
    case Kind::Law:
      return lawProblem(law, coefficients);
  }
  return "unknown kind of response";
}

bool Response::operator==(const Response& other) const {
  if (kind != other.kind) return false;
  switch (kind) {
    case Kind::Constant:
      return constant == other.constant;
    case Kind::Curve:
      return points == other.points;
    case Kind::Law:
      return law == other.law && coefficients == other.coefficients;
  }
  return false;
}

const std::vector<std::string>& lawNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Law& law : laws()) list.push_back(law.name);
    return list;
  }();
  return names;
}

size_t lawCoefficientCount(const std::string& law) {
  const Law* found = findLaw(law);
  return found ? found->coefficients : 0;
}

std::string lawHelp(const std::string& law) {
  const Law* found = findLaw(law);
  return found ? found->help : std::string();
}

ResponseTable::ResponseTable(const Response& response, double firstKelvin, double lastKelvin, size_t samples) {
  samples = std::max<size_t>(samples, 2);
  std::vector<double> values(samples);
  const double step = (lastKelvin - firstKelvin) / static_cast<double>(samples - 1);
  for (size_t i = 0; i < samples; ++i) values[i] = response.at(firstKelvin + step * static_cast<double>(i));
  *this = ResponseTable(std::move(values), firstKelvin, lastKelvin);
}

ResponseTable::ResponseTable(std::vector<double> values, double firstKelvin, double lastKelvin)
    : m_values(std::move(values)), m_first(firstKelvin) {
  if (m_values.empty()) m_values.assign(1, 0.0);
  if (m_values.size() > 1) m_step = (lastKelvin - firstKelvin) / static_cast<double>(m_values.size() - 1);
  if (!(m_step > 0)) {
    m_values.resize(1);
    m_step = 1;
  }
  m_inverseStep = 1 / m_step;
  m_integrals.assign(m_values.size(), 0.0);
  for (size_t i = 1; i < m_values.size(); ++i) {
    m_integrals[i] = m_integrals[i - 1] + 0.5 * m_step * (m_values[i - 1] + m_values[i]);
  }
}

double ResponseTable::at(double kelvin) const {
  if (m_values.empty()) return 0;
  const double u = (kelvin - m_first) * m_inverseStep;
  if (!(u > 0)) return m_values.front();
  const size_t last = m_values.size() - 1;
  if (u >= static_cast<double>(last)) return m_values.back();
  const size_t k = static_cast<size_t>(u);
  const double t = u - static_cast<double>(k);
  return m_values[k] + t * (m_values[k + 1] - m_values[k]);
}

double ResponseTable::integral(double kelvin) const {
  if (m_values.empty()) return 0;
  const double u = (kelvin - m_first) * m_inverseStep;
  if (!(u > 0)) return (kelvin - m_first) * m_values.front();
  const size_t last = m_values.size() - 1;
  if (u >= static_cast<double>(last)) {
    return m_integrals.back() + (u - static_cast<double>(last)) * m_step * m_values.back();
  }
  const size_t k = static_cast<size_t>(u);
  const double t = u - static_cast<double>(k);
  return m_integrals[k] + m_step * t * (m_values[k] + 0.5 * t * (m_values[k + 1] - m_values[k]));
}

}  // namespace ps
