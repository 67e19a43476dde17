// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/monotone.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// A curve through points, each of which says how it goes on to the next: properties over temperature, keys over time.
// The functions are of points with members toNext, slopeBefore, slopeAfter and functions xOf() and yOf(), that ascend
// in x. A smooth piece is the cubic Hermite polynomial with the slopes of its two points. Where a point states none it
// is the one of a monotone cubic (Fritsch & Carlson 1980), from the secants of the pieces beside it, so that values
// between two points never leave those of the points; a piece that steps has no secant, and the slope is then that of
// the other side alone. Stated slopes may lead beyond the points' values: see turnsOn().
namespace ps {

/// What lies between a point and the next one.
enum class ToNext : uint8_t {
  Step,    ///< the point's value
  Linear,  ///< a straight line
  Smooth,  ///< a cubic
};

/// "step", "linear", "smooth", as files have it.
inline const std::vector<std::string>& toNextNames() {
  static const std::vector<std::string> names{"step", "linear", "smooth"};
  return names;
}

/// A point of a curve: of a property in K and its unit.
struct CurvePoint {
  double x = 0, y = 0;
  ToNext toNext = ToNext::Smooth;
  std::optional<double> slopeBefore{}, slopeAfter{};  ///< of y over x, of smooth pieces on either side
  bool operator==(const CurvePoint&) const = default;
};
inline double xOf(const CurvePoint& point) { return point.x; }
inline double yOf(const CurvePoint& point) { return point.y; }

template <class Point>
double lengthOf(const std::vector<Point>& points, size_t piece) {
  return xOf(points[piece + 1]) - xOf(points[piece]);
}

template <class Point>
double secantOf(const std::vector<Point>& points, size_t piece) {
  return (yOf(points[piece + 1]) - yOf(points[piece])) / lengthOf(points, piece);
}

/// Slope of the monotone cubic at an end of a piece. `later`: the one with the greater x.
template <class Point>
double monotoneSlope(const std::vector<Point>& points, size_t piece, bool later) {
  const auto counts = [&](size_t other) {
    return other < points.size() - 1 && points[other].toNext != ToNext::Step;  // before the first it is beyond all
  };
  const size_t beside = later ? piece + 1 : piece - 1, inner = later ? piece - 1 : piece + 1;
  const double d = secantOf(points, piece);
  if (counts(beside)) {
    const size_t first = std::min(piece, beside);
    return innerSlope(lengthOf(points, first), lengthOf(points, first + 1), secantOf(points, first),
                      secantOf(points, first + 1));
  }
  if (counts(inner)) return endSlope(lengthOf(points, piece), lengthOf(points, inner), d, secantOf(points, inner));
  return d;
}

/// The slope with which a smooth piece leaves a point, or reaches it, stated or not; 0 beyond the ends.
template <class Point>
double slopeAfter(const std::vector<Point>& points, size_t k) {
  if (points[k].slopeAfter) return *points[k].slopeAfter;
  return k + 1 < points.size() ? monotoneSlope(points, k, false) : 0;
}

template <class Point>
double slopeBefore(const std::vector<Point>& points, size_t k) {
  if (points[k].slopeBefore) return *points[k].slopeBefore;
  return k > 0 ? monotoneSlope(points, k - 1, true) : 0;
}

/// The value at an x within a piece. Slopes of any file may be too steep to count: then the value of its first point.
template <class Point>
double valueOn(const std::vector<Point>& points, size_t piece, double x) {
  const Point& from = points[piece];
  const double y0 = yOf(from), y1 = yOf(points[piece + 1]);
  if (from.toNext == ToNext::Step) return y0;
  const double h = lengthOf(points, piece), t = (x - xOf(from)) / h;
  if (from.toNext == ToNext::Linear) return y0 + t * (y1 - y0);
  const double m0 = slopeAfter(points, piece) * h, m1 = slopeBefore(points, piece + 1) * h;
  if (y0 == y1 && m0 == 0 && m1 == 0) return y0;  // not a bit beside it
  const double y = hermite(t, y0, m0, y1, m1);
  return std::isfinite(y) ? y : y0;
}

/// Where a piece with a stated slope turns between its points: at most two x. Others turn nowhere.
template <class Point>
std::vector<double> turnsOn(const std::vector<Point>& points, size_t piece) {
  const Point &from = points[piece], &to = points[piece + 1];
  if (from.toNext != ToNext::Smooth || (!from.slopeAfter && !to.slopeBefore)) return {};
  const double h = lengthOf(points, piece);
  double rise = yOf(to) - yOf(from), m0 = slopeAfter(points, piece) * h, m1 = slopeBefore(points, piece + 1) * h;
  const double largest = std::max({std::abs(rise), std::abs(m0), std::abs(m1)});
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  for (double* each : {&rise, &m0, &m1}) *each /= largest;  // no square of theirs is infinite
  // The cubic's derivative in t is c + b t + a t^2.
  const double a = 3 * (m0 + m1 - 2 * rise), b = 2 * (3 * rise - 2 * m0 - m1), c = m0, square = b * b - 4 * a * c;
  if (!(square >= 0)) return {};
  std::vector<double> turns;
  const double q = -0.5 * (b + std::copysign(std::sqrt(square), b));  // without cancellation
  for (const double t : {q / a, c / q}) {
    if (t > 0 && t < 1) turns.push_back(xOf(from) + t * h);
  }
  return turns;
}

}  // namespace ps
