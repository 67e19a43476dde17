// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/casemeasure.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

namespace ps {
namespace {

using nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const double kNone = std::numeric_limits<double>::quiet_NaN();

double option(const json& options, const char* key, double fallback) {
  const auto found = options.find(key);
  return found == options.end() ? fallback : found->get<double>();
}

/// Share of the way from value k - 1 to value k at which `level` lies.
double shareOf(const Series& s, size_t k, double level) {
  return (level - s.value[k - 1]) / (s.value[k] - s.value[k - 1]);
}

double timeAt(const Series& s, size_t k, double level) {
  return s.time[k - 1] + shareOf(s, k, level) * (s.time[k] - s.time[k - 1]);
}

/// The values between the times `from` and `to`.
std::vector<double> within(const Series& s, const json& options) {
  const double from = option(options, "from", -kInfinity), to = option(options, "to", kInfinity);
  std::vector<double> values;
  for (size_t k = 0; k < s.time.size(); ++k) {
    if (s.time[k] >= from && s.time[k] <= to) values.push_back(s.value[k]);
  }
  return values;
}

using Numbers = const std::vector<double>&;
double mean(Numbers values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double minimum(Numbers values) { return *std::min_element(values.begin(), values.end()); }
double maximum(Numbers values) { return *std::max_element(values.begin(), values.end()); }
double change(Numbers values) { return values.back() - values.front(); }
double range(Numbers values) { return maximum(values) - minimum(values); }

double at(const Series& s, double time) {
  for (size_t k = 1; k < s.time.size(); ++k) {
    if (s.time[k - 1] > time || s.time[k] < time) continue;
    return s.value[k - 1] + (time - s.time[k - 1]) / (s.time[k] - s.time[k - 1]) * (s.value[k] - s.value[k - 1]);
  }
  return kNone;
}

double when(const Series& s, double level) {
  for (size_t k = 1; k < s.value.size(); ++k) {
    if ((s.value[k - 1] < level) != (s.value[k] < level)) return timeAt(s, k, level);
  }
  return kNone;
}

/// Frames of the first stretch strictly between two values; first > last without two of them.
struct Stretch {
  size_t first = 1, last = 0;
};
Stretch plateau(const Series& s, double from, double to) {
  const double low = std::min(from, to), high = std::max(from, to);
  const auto within = [&](size_t k) { return s.value[k] > low && s.value[k] < high; };
  size_t first = 0;
  while (first < s.value.size() && !within(first)) ++first;
  size_t end = first;
  while (end < s.value.size() && within(end)) ++end;
  return end >= first + 2 ? Stretch{first, end - 1} : Stretch{};
}

double begins(const Series& s, double from, double to) {
  const Stretch p = plateau(s, from, to);
  return p.last > p.first ? timeAt(s, p.first + 1, from) : kNone;
}

double ends(const Series& s, double from, double to) {
  const Stretch p = plateau(s, from, to);
  return p.last > p.first ? timeAt(s, p.last, to) : kNone;
}

double fastest(const Series& s, size_t frames) {
  double most = kNone;
  for (size_t k = frames; k < s.value.size(); ++k) {
    const double rate = (s.value[k] - s.value[k - frames]) / (s.time[k] - s.time[k - frames]);
    if (!(rate <= most)) most = rate;
  }
  return most;
}

double period(const Series& s, double level, double most) {
  std::vector<double> crossings;
  for (size_t k = 1; k < s.value.size(); ++k) {
    if (s.value[k - 1] > level && s.value[k] <= level) crossings.push_back(timeAt(s, k, level));
  }
  if (crossings.size() < 2) return kNone;
  if (most < static_cast<double>(crossings.size() - 1)) crossings.resize(static_cast<size_t>(most) + 1);
  return (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
}

using Measure = std::function<double(const Series&, const json&)>;

/// A measure of the values of a span of time.
Measure over(double (*of)(Numbers)) {
  return [of](const Series& s, const json& options) {
    const std::vector<double> values = within(s, options);
    return values.empty() ? kNone : of(values);
  };
}

Measure ofPlateau(double (*of)(const Series&, double, double)) {
  return [of](const Series& s, const json& options) {
    return of(s, option(options, "from", 0), option(options, "to", 1));
  };
}

const std::map<std::string, Measure>& measures() {
  static const std::map<std::string, Measure> all{
      {"last", [](const Series& s, const json&) { return s.value.back(); }},
      {"first", [](const Series& s, const json&) { return s.value.front(); }},
      {"change", over(change)},
      {"range", over(range)},
      {"minimum", over(minimum)},
      {"maximum", over(maximum)},
      {"mean", over(mean)},
      {"at", [](const Series& s, const json& o) { return at(s, option(o, "time", 0)); }},
      {"when", [](const Series& s, const json& o) { return when(s, option(o, "value", 0)); }},
      {"slope",
       [](const Series& s, const json& o) {
         const double from = option(o, "from", 0), to = option(o, "to", 0);
         return (to - from) / (when(s, to) - when(s, from));
       }},
      {"begins", ofPlateau([](const Series& s, double from, double to) { return begins(s, from, to); })},
      {"ends", ofPlateau([](const Series& s, double from, double to) { return ends(s, from, to); })},
      {"lasts",
       ofPlateau([](const Series& s, double from, double to) { return ends(s, from, to) - begins(s, from, to); })},
      {"fastest", [](const Series& s,
                     const json& o) { return fastest(s, static_cast<size_t>(std::max(1.0, option(o, "frames", 1)))); }},
      {"period",
       [](const Series& s, const json& o) {
         return period(s, option(o, "level", 0), std::max(1.0, option(o, "periods", kInfinity)));
       }},
  };
  return all;
}

}  // namespace

std::vector<std::string> measureNames() {
  std::vector<std::string> names;
  for (const auto& [name, measure] : measures()) names.push_back(name);
  return names;
}

double measureOf(const Series& series, const std::string& measure, const json& options) {
  return series.value.empty() ? kNone : measures().at(measure)(series, options);
}

}  // namespace ps
