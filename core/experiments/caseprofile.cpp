// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/caseprofile.h"

#include "core/base/error.h"
#include "core/simulation/engine.h"
#include "core/solver/solver.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

namespace ps {
namespace {

const double kNone = std::numeric_limits<double>::quiet_NaN();

/// Two half spaces in contact.
struct HalfSpaces {
  double place, left, right, leftConductivity, leftCapacity, rightConductivity, rightCapacity;

  explicit HalfSpaces(const std::vector<double>& a)
      : place(a[0]),
        left(a[1]),
        right(a[2]),
        leftConductivity(a[3]),
        leftCapacity(a[4]),
        rightConductivity(a[5]),
        rightCapacity(a[6]) {}

  double contact() const {
    const double l = std::sqrt(leftConductivity * leftCapacity), r = std::sqrt(rightConductivity * rightCapacity);
    return (l * left + r * right) / (l + r);
  }
  double at(double x, double time) const {
    const bool here = x < place;
    const double diffusivity = here ? leftConductivity / leftCapacity : rightConductivity / rightCapacity;
    const double depth = std::abs(x - place) / (2 * std::sqrt(diffusivity * time));
    return contact() + ((here ? left : right) - contact()) * std::erf(depth);
  }
};

struct Law {
  size_t arguments;
  double (*at)(const std::vector<double>&, double x, double time);
  double (*range)(const std::vector<double>&);  ///< K
};

const std::map<std::string, Law> kLaws{
    {"half_spaces",
     {7, [](const std::vector<double>& a, double x, double time) { return HalfSpaces(a).at(x, time); },
      [](const std::vector<double>& a) { return std::abs(a[2] - a[1]); }}},
    {"line",
     {4,
      [](const std::vector<double>& a, double x, double) { return a[1] + (x - a[0]) / (a[2] - a[0]) * (a[3] - a[1]); },
      [](const std::vector<double>& a) { return std::abs(a[3] - a[1]); }}},
};

struct Sample {
  double x, temperature;
};

/// Differences from the law as shares of its range.
std::vector<double> errorsOf(const std::vector<Sample>& samples, const ProfileCheck& check, double time) {
  const Law& law = kLaws.at(check.law);
  std::vector<double> errors;
  errors.reserve(samples.size());
  for (const Sample& s : samples) {
    errors.push_back(std::abs(s.temperature - law.at(check.arguments, s.x, time)) / law.range(check.arguments));
  }
  return errors;
}

double contactOf(const std::vector<Sample>& samples, const ProfileCheck& check, double spacing) {
  const HalfSpaces law(check.arguments);
  double sum[2] = {0, 0}, count[2] = {0, 0};
  for (const Sample& s : samples) {
    if (std::abs(s.x - law.place) >= spacing) continue;
    const size_t side = s.x < law.place ? 0 : 1;
    sum[side] += s.temperature;
    ++count[side];
  }
  if (count[0] == 0 || count[1] == 0) return kNone;
  const double l = law.leftConductivity, r = law.rightConductivity;
  return (l * sum[0] / count[0] + r * sum[1] / count[1]) / (l + r);
}

double slipOf(const std::vector<Sample>& samples, const ProfileCheck& check, double spacing) {
  const std::vector<double>& a = check.arguments;
  const double low = std::min(a[0], a[2]) + 2 * spacing, high = std::max(a[0], a[2]) - 2 * spacing;
  double n = 0, sx = 0, st = 0, sxx = 0, sxt = 0;
  for (const Sample& s : samples) {
    if (s.x < low || s.x > high) continue;
    const double x = s.x - a[0];
    n += 1, sx += x, st += s.temperature, sxx += x * x, sxt += x * s.temperature;
  }
  const double slope = (n * sxt - sx * st) / (n * sxx - sx * sx), start = (st - slope * sx) / n;
  const double first = std::abs((start - a[1]) / slope),
               second = std::abs((start + slope * (a[2] - a[0]) - a[3]) / slope);
  return std::max(first, second) / spacing;
}

/// Laws that a measure is of; "" for any.
const std::map<std::string, std::string> kMeasures{
    {"l2", ""}, {"linf", ""}, {"contact", "half_spaces"}, {"slip", "line"}};

template <class Map>
std::vector<std::string> namesOf(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

}  // namespace

TemperatureField temperatureField(Engine& engine) {
  const Solver& solver = engine.solver();
  const ParticleStore& store = solver.particles();
  TemperatureField field;
  field.thermalTime = solver.thermalTime();
  field.spacing = numberOf(engine.project().solver.parameters, solverParameters(), "particle_spacing");
  for (size_t i = 0; i < store.size(); ++i) {
    const api::Double3 p = store.wrappedPosition(i);
    field.points.push_back({{p.x, p.y, p.z}, store.temperature()[i]});
  }
  return field;
}

std::vector<std::string> profileLaws() { return namesOf(kLaws); }
std::vector<std::string> profileMeasures() { return namesOf(kMeasures); }

double profileValue(const TemperatureField& field, const ProfileCheck& check) {
  if (check.arguments.size() != kLaws.at(check.law).arguments) {
    throw InputError("the law '" + check.law + "' takes " + std::to_string(kLaws.at(check.law).arguments) +
                     " arguments");
  }
  if (const std::string& law = kMeasures.at(check.measure); !law.empty() && law != check.law) {
    throw InputError("'" + check.measure + "' is a measure of the law '" + law + "'");
  }
  std::vector<Sample> samples;
  for (const TemperatureField::Point& p : field.points) {
    const double x = p.place[check.axis];
    if (x >= check.from && x <= check.to) samples.push_back({x, p.temperature});
  }
  if (samples.empty()) return kNone;
  if (check.measure == "contact") return contactOf(samples, check, field.spacing);
  if (check.measure == "slip") return slipOf(samples, check, field.spacing);
  const std::vector<double> errors = errorsOf(samples, check, field.thermalTime);
  if (check.measure == "linf") return *std::max_element(errors.begin(), errors.end());
  double squares = 0;
  for (const double e : errors) squares += e * e;
  return std::sqrt(squares / static_cast<double>(errors.size()));
}

}  // namespace ps
