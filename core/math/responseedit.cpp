// SPDX-License-Identifier: Apache-2.0
#include "core/math/responseedit.h"

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace ps {
namespace {

constexpr double kGasConstant = 8.314462618;  // J/(mol K)
constexpr int kGrid = 24;                     // starts along one coefficient

using Points = std::span<const CurvePoint>;
using Coefficients = std::vector<double>;

Response lawOf(const std::string& name, Coefficients coefficients) {
  Response response;
  response.kind = Response::Kind::Law;
  response.law = name;
  response.coefficients = std::move(coefficients);
  return response;
}

/// Intercept and slope of the straight line nearest to v over u.
template <class U, class V>
std::pair<double, double> line(Points points, U u, V v) {
  const double n = static_cast<double>(points.size());
  double meanU = 0, meanV = 0, uu = 0, uv = 0;
  for (const auto& p : points) meanU += u(p) / n, meanV += v(p) / n;
  for (const auto& p : points) {
    uu += (u(p) - meanU) * (u(p) - meanU);
    uv += (u(p) - meanU) * (v(p) - meanV);
  }
  const double slope = uu > 0 ? uv / uu : 0;
  return {meanV - slope * meanU, slope};
}

double logOf(const CurvePoint& p) { return std::log(p.y); }

/// ln of the two laws that are not straight, without the bounds of Response::at, so that they stay smooth.
double logVogel(const Coefficients& c, double kelvin) { return std::log(10.0) * (c[0] + c[1] / (kelvin - c[2])); }
double logSigmoid(const Coefficients& c, double kelvin) {
  const double x = (kelvin - c[1]) / c[2];
  return std::log(2 * c[0]) - (x > 0 ? x + std::log1p(std::exp(-x)) : std::log1p(std::exp(x)));
}

using LogLaw = double (*)(const Coefficients&, double kelvin);

double squares(LogLaw law, const Coefficients& c, Points points) {
  double sum = 0;
  for (const auto& p : points) sum += std::pow(law(c, p.x) - logOf(p), 2);
  return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
}

/// Residuals in the shape that Eigen's solver asks for.
struct Residuals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };
  LogLaw law = nullptr;
  Points points{};
  int inputs() const { return 3; }
  int values() const { return static_cast<int>(points.size()); }
  int operator()(const InputType& c, ValueType& out) const {
    const Coefficients at(c.data(), c.data() + c.size());
    for (size_t i = 0; i < points.size(); ++i) {
      const double left = law(at, points[i].x) - logOf(points[i]);
      out[static_cast<Eigen::Index>(i)] = std::isfinite(left) ? left : 1e6;
    }
    return 0;
  }
};

Coefficients refined(LogLaw law, const Coefficients& start, Points points) {
  Eigen::NumericalDiff<Residuals, Eigen::Central> residuals(Residuals{law, points});
  Eigen::LevenbergMarquardt<decltype(residuals)> solver(residuals);
  solver.parameters.maxfev = 4000;
  solver.parameters.xtol = solver.parameters.ftol = 1e-14;
  Eigen::VectorXd c = Eigen::Map<const Eigen::VectorXd>(start.data(), static_cast<Eigen::Index>(start.size()));
  solver.minimize(c);
  const Coefficients end(c.data(), c.data() + c.size());
  return squares(law, end, points) <= squares(law, start, points) ? end : start;
}

/// With T0 given a Vogel law is a straight line over 1/(T - T0): the best T0 of a grid below the coldest point.
Coefficients vogelStart(Points points) {
  const double coldest = points.front().x, span = points.back().x - coldest;
  Coefficients best;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kGrid; ++i) {
    const double t0 = coldest - span * std::pow(10.0, -2 + 3.5 * i / (kGrid - 1));
    const auto [a, b] = line(
        points, [&](const auto& p) { return 1 / (p.x - t0); }, logOf);
    const Coefficients c{a / std::log(10.0), b / std::log(10.0), t0};
    if (const double sum = squares(logVogel, c, points); c[1] > 0 && sum < least) {
      least = sum;
      best = c;
    }
  }
  return best;
}

/// With T_ref and dT given only the height is left, a mean.
Coefficients sigmoidStart(Points points) {
  const double coldest = points.front().x, span = points.back().x - coldest;
  const bool falls = points.back().y <= points.front().y;
  Coefficients best;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kGrid; ++i) {
    for (int j = 0; j < kGrid; ++j) {
      const double width = span * std::pow(10.0, -2 + 2.5 * j / (kGrid - 1));
      Coefficients c{0.5, coldest + span * (-0.5 + 2.0 * i / (kGrid - 1)), falls ? width : -width};
      double mean = 0;
      for (const auto& p : points) mean += (logOf(p) - logSigmoid(c, p.x)) / static_cast<double>(points.size());
      c[0] *= std::exp(mean);
      if (const double sum = squares(logSigmoid, c, points); sum < least) {
        least = sum;
        best = c;
      }
    }
  }
  return best;
}

Coefficients coefficientsOf(const std::string& law, Points points, double reference) {
  const auto kelvin = [&](const auto& p) { return p.x - reference; };
  if (law == "linear") {
    const auto [a, b] = line(points, kelvin, [](const auto& p) { return p.y; });
    return {a, b, reference};
  }
  if (law == "exponential") {
    const auto [a, b] = line(points, kelvin, logOf);
    return {std::exp(a), reference, b == 0 ? 0 : -1 / b};
  }
  if (law == "arrhenius") {
    const auto [a, b] = line(
        points, [&](const auto& p) { return 1 / p.x - 1 / reference; }, logOf);
    return {std::exp(a), b * kGasConstant, reference};
  }
  const bool vogel = law == "vogel";
  const Coefficients start = vogel ? vogelStart(points) : sigmoidStart(points);
  return start.empty() ? start : refined(vogel ? logVogel : logSigmoid, start, points);
}

std::string whyNoFit(const std::string& law, Points points) {
  if (lawCoefficientCount(law) == 0) return "There is no law “" + law + "”.";
  const size_t needed = law == "vogel" || law == "thesis_sigmoid" ? 3 : 2;
  if (points.size() < needed) return "This law needs " + std::to_string(needed) + " points.";
  if (law == "linear") return {};
  if (std::any_of(points.begin(), points.end(), [](const auto& p) { return p.y <= 0; }))
    return "This law needs values above 0.";
  return {};
}

}  // namespace

std::vector<CurvePoint> sampled(const Response& response, double firstKelvin, double lastKelvin, size_t count) {
  count = std::max<size_t>(count, 2);
  std::vector<CurvePoint> points(count);
  for (size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    points[i].x = firstKelvin + share * (lastKelvin - firstKelvin);
    points[i].y = response.at(points[i].x);
  }
  return points;
}

Response curveThrough(std::vector<CurvePoint> points) {
  Response curve;
  curve.kind = Response::Kind::Curve;
  curve.points = std::move(points);
  return curve;
}

bool addPoint(Response& curve, api::ResponsePoint point) {
  const auto above = std::upper_bound(curve.points.begin(), curve.points.end(), point.x,
                                      [](double x, const auto& p) { return x < p.x; });
  if (above != curve.points.end() && above->x - point.x < kPointGap) return false;
  if (above != curve.points.begin() && point.x - std::prev(above)->x < kPointGap) return false;
  const ToNext way = above == curve.points.begin() ? ToNext::Smooth : std::prev(above)->toNext;
  curve.points.insert(above, {point.x, point.y, way});
  return true;
}

void movePoint(Response& curve, size_t index, api::ResponsePoint to) {
  std::vector<CurvePoint>& p = curve.points;
  if (index > 0) to.x = std::max(to.x, p[index - 1].x + kPointGap);
  if (index + 1 < p.size()) to.x = std::min(to.x, p[index + 1].x - kPointGap);
  p[index].x = to.x;
  p[index].y = to.y;
}

Between betweenOf(const Response& curve, size_t piece) {
  const CurvePoint& from = curve.points[piece];
  if (from.toNext == ToNext::Step) return Between::Step;
  if (from.toNext == ToNext::Linear) return Between::Linear;
  return from.slopeAfter || curve.points[piece + 1].slopeBefore ? Between::Stated : Between::Monotone;
}

void setBetween(Response& curve, size_t piece, Between way) {
  CurvePoint &from = curve.points[piece], &to = curve.points[piece + 1];
  from.toNext = way == Between::Step ? ToNext::Step : way == Between::Linear ? ToNext::Linear : ToNext::Smooth;
  if (way == Between::Stated) {
    const double after = slopeAfter(curve.points, piece), before = slopeBefore(curve.points, piece + 1);
    from.slopeAfter = after;
    to.slopeBefore = before;
  } else {
    from.slopeAfter.reset();
    to.slopeBefore.reset();
  }
}

bool hasSlope(const Response& curve, size_t index, bool after) {
  if (curve.kind != Response::Kind::Curve || index >= curve.points.size()) return false;
  if (after) return index + 1 < curve.points.size() && curve.points[index].toNext == ToNext::Smooth;
  return index > 0 && curve.points[index - 1].toNext == ToNext::Smooth;
}

void stateSlope(Response& curve, size_t index, double slope, Sides sides) {
  if (sides != Sides::After && hasSlope(curve, index, false)) curve.points[index].slopeBefore = slope;
  if (sides != Sides::Before && hasSlope(curve, index, true)) curve.points[index].slopeAfter = slope;
}

void removePoint(Response& curve, size_t index) {
  if (curve.points.size() > 1) curve.points.erase(curve.points.begin() + static_cast<std::ptrdiff_t>(index));
}

Response shifted(const Response& curve, double kelvin, double amount, double factor) {
  Response result = curve.scaled(factor);
  for (CurvePoint& p : result.points) {
    p.x += kelvin;
    p.y += amount;
  }
  return result;
}

LawFit fitLaw(const std::string& law, std::span<const CurvePoint> points, double referenceKelvin) {
  LawFit fit;
  fit.problem = whyNoFit(law, points);
  if (!fit.problem.empty()) return fit;
  fit.law = lawOf(law, coefficientsOf(law, points, referenceKelvin));
  if (!fit.law.problem().empty()) {
    fit.problem = "No law of this kind goes through these points.";
    return fit;
  }
  double sum = 0;
  for (const auto& p : points) {
    const double y = fit.law.at(p.x);
    sum += std::pow(law == "linear" ? y - p.y : std::log(y / p.y), 2);
  }
  fit.error = std::sqrt(sum / static_cast<double>(points.size()));
  return fit;
}

}  // namespace ps
