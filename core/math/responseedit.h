// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/response.h"

#include <span>
#include <string>
#include <vector>

// What somebody does to a response by hand: points that come, move and go, and the ways between points and laws.
namespace ps {

/// The least distance in K between two points of a curve that is edited.
inline constexpr double kPointGap = 0.01;
/// Points of a law to which another one is fitted.
inline constexpr size_t kLawPoints = 9;
/// How far the points that a law becomes may be off, as thinned() measures it.
inline constexpr double kLawTolerance = 0.02;

/// `count` points (2 at least) of a response at even distances from one temperature in K to another.
std::vector<CurvePoint> sampled(const Response& response, double firstKelvin, double lastKelvin, size_t count);

/// A curve through points that ascend in x.
Response curveThrough(std::vector<CurvePoint> points);

/// A curve with one more point. False, and nothing happens: one stands there already, within kPointGap. Another kind of
/// response must be sampled first.
bool addPoint(Response& curve, api::ResponsePoint point);

/// Moves a point of a curve to another place, in temperature no farther than its neighbours let it.
void movePoint(Response& curve, size_t index, api::ResponsePoint to);

/// How a curve goes from a point to the next, as people choose it: smooth pieces with and without a stated slope.
enum class Between { Step, Linear, Monotone, Stated };
Between betweenOf(const Response& curve, size_t piece);
/// The stated slopes of a piece are at first those that it has.
void setBetween(Response& curve, size_t piece, Between way);
/// Whether a smooth piece meets a point, from before it or after it.
bool hasSlope(const Response& curve, size_t index, bool after);
/// States the slope, in units of the value per K, of each smooth piece that meets a point, or of one alone.
enum class Sides { Both, Before, After };
void stateSlope(Response& curve, size_t index, double slope, Sides sides = Sides::Both);

/// Takes a point away; the last one stays.
void removePoint(Response& curve, size_t index);

/// Moves all points of a curve by so many K; and up by an amount, or by a factor where the property is logarithmic.
Response shifted(const Response& curve, double kelvin, double amount, double factor);

/// A curve with as few of its points as keep it within a tolerance of what it was, `error` the most that is between the
/// two: of the values' logarithms, or as a share of the largest value. Points come where the curve is farthest off (as
/// with Ramer 1972, Douglas & Peucker 1973), then those that are not needed any more go again.
struct Thinned {
  Response curve;
  double error = 0;
};
Thinned thinned(const Response& curve, double tolerance, bool logarithmic);
/// A curve in the place of a law or a constant, from one temperature in K to another, within kLawTolerance.
Response asPoints(const Response& response, double firstKelvin, double lastKelvin, bool logarithmic);

/// A law laid through points.
struct LawFit {
  Response law;
  double error = 0;     ///< root of the mean square: of "linear" in the property's unit, else relative (of ln y)
  std::string problem;  ///< "" or why there is none, as a sentence
};

/// The law of a name that is nearest to points: least squares of y for "linear", of ln y for the others, so that each
/// decade of a viscosity weighs the same. Where T_ref says only what `a` belongs to (linear, exponential, arrhenius),
/// it is `referenceKelvin`. Straight lines are solved at once; "vogel" and "thesis_sigmoid" from the best of a coarse
/// grid by Levenberg and Marquardt (Moré 1978), to about 1e-6 of each coefficient where the points lie on a law. Needs
/// two points for a line, three for those, and values above 0 for all but "linear".
LawFit fitLaw(const std::string& law, std::span<const CurvePoint> points, double referenceKelvin);

}  // namespace ps
