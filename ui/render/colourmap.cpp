// SPDX-License-Identifier: Apache-2.0
#include "ui/render/colourmap.h"

#include "core/base/error.h"
#include "ui/render/resource.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace ps {
namespace {

using render::Colour;

constexpr const char* kTemperature = "temperature";  // its map has a pivot

struct Stop {
  double at;
  Colour colour;
};
struct Maps {
  std::map<std::string, std::vector<Stop>> byName;
  std::map<std::string, std::map<std::string, Colour>> scene;    // by theme
  std::map<std::string, std::vector<render::Pattern>> patterns;  // by map, of its classes
  double temperaturePivot = 0.36;
};

render::Pattern parsePattern(const std::string& name) {
  constexpr std::array kNames{"plain", "stripes", "dots", "checks"};
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) throw Error("maps.json: there is no pattern '" + name + "'");
  return static_cast<render::Pattern>(found - kNames.begin());
}

Colour parseColour(const std::string& text) {
  unsigned value = 0;
  if (text.size() != 7 || text[0] != '#' ||
      std::from_chars(text.data() + 1, text.data() + 7, value, 16).ptr != text.data() + 7)
    throw Error("maps.json: a colour must be six hexadecimal digits after a number sign, not '" + text + "'");
  return {static_cast<float>(value >> 16) / 255, static_cast<float>(value >> 8 & 255) / 255,
          static_cast<float>(value & 255) / 255};
}

Maps readMaps() {
  const nlohmann::json json = nlohmann::json::parse(render::embeddedText("maps.json"));
  Maps maps;
  for (const auto& [name, stops] : json.at("maps").items())
    for (const auto& stop : stops)
      maps.byName[name].push_back({stop.at(0).get<double>(), parseColour(stop.at(1).get<std::string>())});
  for (const auto& [theme, colours] : json.at("scene").items())
    for (const auto& [name, colour] : colours.items()) maps.scene[theme][name] = parseColour(colour.get<std::string>());
  for (const auto& [name, patterns] : json.at("patterns").items())
    for (const auto& pattern : patterns) maps.patterns[name].push_back(parsePattern(pattern.get<std::string>()));
  maps.temperaturePivot = json.at("pivots").at("temperature").get<double>();
  return maps;
}

const Maps& maps() {
  static const Maps kMaps = readMaps();
  return kMaps;
}

Colour sample(const std::vector<Stop>& stops, double t) {
  t = std::clamp(t, 0.0, 1.0);
  size_t i = 1;
  while (i + 1 < stops.size() && stops[i].at < t) ++i;
  const Stop &a = stops[i - 1], &b = stops[i];
  const auto f = static_cast<float>(std::clamp((t - a.at) / (b.at - a.at), 0.0, 1.0));
  Colour out{};
  for (size_t k = 0; k < 3; ++k) out[k] = a.colour[k] + (b.colour[k] - a.colour[k]) * f;
  return out;
}

// Smallest of 1, 2, 5 times a power of ten that is not less than `value`.
double roundUp(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * decade * (1 + 1e-9)) return step * decade;
  return 10 * decade;
}

/// Whole steps of 10 degrees Celsius, so that the legend stands still while matter warms.
std::pair<double, double> celsiusRange(double low, double high) {
  constexpr double kZero = 273.15, kStep = 10;
  const double first = std::floor((low - kZero) / kStep + 1e-3) * kStep;
  const double last = std::ceil((high - kZero) / kStep - 1e-3) * kStep;
  return {first + kZero, std::max(last, first + kStep) + kZero};
}

/// From zero where values come near it, else between round numbers.
std::pair<double, double> roundRange(double low, double high, double least) {
  if (low == 0 && high == 0) return {0, least > 0 ? least : 1};
  if (least > 0 || (low >= 0 && low <= 0.5 * high)) return {0, roundUp(std::max(high, least))};
  const double step = roundUp(std::max(high - low, 1e-2 * std::max(std::abs(low), std::abs(high)))) / 10;
  const double first = std::floor(low / step + 1e-3) * step, last = std::ceil(high / step - 1e-3) * step;
  return {first, std::max(last, first + step)};
}

}  // namespace

std::pair<double, double> colourRange(const Snapshot& snapshot, const std::string& colour) {
  const ShownField shown(snapshot, colour);
  if (!shown) return {0, 0};
  const ParticleField& field = shown.field();
  if (field.hasScale()) return {field.minimum, field.maximum};
  const bool kelvin = field.unit == "K";
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (size_t i = 0; i < snapshot.position.size(); ++i) {
    const auto value = static_cast<double>(shown[i]);
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return kelvin ? std::pair{273.15, 373.15} : std::pair{0.0, 1.0};
  return kelvin ? celsiusRange(low, high) : roundRange(low, high, field.least);
}

std::string colourMapOf(const std::string& colour) { return maps().byName.contains(colour) ? colour : "ember"; }

std::array<float, 3> colourAt(const std::string& colour, double t, double pivot) {
  const auto found = maps().byName.find(colourMapOf(colour));
  if (colour == kTemperature) {
    const double fixed = maps().temperaturePivot;
    // Each side of the melting point is linear up to its own end, also where that lies outside the range; farther off
    // than the range is long counts as that far, so that half of a side's colours are left at least.
    pivot = std::clamp(pivot, -1.0, 2.0);
    if (t < pivot)
      t = fixed * t / pivot;
    else
      t = pivot < 1 ? fixed + (1 - fixed) * (t - pivot) / (1 - pivot) : fixed;
  }
  return sample(found->second, t);
}

namespace render {

Colour sceneColour(bool dark, const std::string& name) {
  const auto& colours = maps().scene.at(dark ? "dark" : "light");
  const auto found = colours.find(name);
  if (found == colours.end()) throw Error("maps.json: the scene has no colour '" + name + "'");
  return found->second;
}

Pattern patternOf(const std::string& colour, float value) {
  const auto found = maps().patterns.find(colour);
  if (found == maps().patterns.end() || !(value >= 0)) return Pattern::Plain;
  const auto index = static_cast<size_t>(value + 0.5f);
  return index < found->second.size() ? found->second[index] : Pattern::Plain;
}

ColourTable::ColourTable(const std::string& colour, double minimum, double maximum, double meltingPoint)
    : m_minimum(static_cast<float>(minimum)), m_scale(static_cast<float>(1 / std::max(maximum - minimum, 1e-12))) {
  const double pivot = (meltingPoint - minimum) / std::max(maximum - minimum, 1e-12);
  if (colour == kMatterColour) return;  // has no map
  for (size_t i = 0; i < m_samples.size(); ++i)
    m_samples[i] = colourAt(colour, static_cast<double>(i) / static_cast<double>(m_samples.size() - 1), pivot);
}

const Colour& ColourTable::at(float value) const {
  const float share = (value - m_minimum) * m_scale;
  const float t = share > 0 ? std::min(share, 1.f) : 0;  // of what is no number, the lower end
  return m_samples[static_cast<size_t>(t * static_cast<float>(m_samples.size() - 1) + 0.5f)];
}

}  // namespace render
}  // namespace ps
