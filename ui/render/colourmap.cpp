// SPDX-License-Identifier: Apache-2.0
#include "ui/render/colourmap.h"

#include "core/base/error.h"
#include "ui/render/resource.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <vector>

namespace ps {
namespace {

using render::Colour;

struct Stop {
  double at;
  Colour colour;
};
struct Maps {
  std::map<std::string, std::vector<Stop>> byName;
  std::map<std::string, std::map<std::string, Colour>> scene;  // by theme
  double temperaturePivot = 0.36;
};

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

std::pair<double, double> temperatureRange(const Snapshot& snapshot) {
  if (snapshot.temperature.empty()) return {273.15, 373.15};
  const auto [low, high] = std::minmax_element(snapshot.temperature.begin(), snapshot.temperature.end());
  // Whole steps of 10 degrees Celsius, so that the legend stands still while matter warms.
  constexpr double kZero = 273.15, kStep = 10;
  const double first = std::floor((*low - kZero) / kStep + 1e-3) * kStep;
  const double last = std::ceil((*high - kZero) / kStep - 1e-3) * kStep;
  return {first + kZero, std::max(last, first + kStep) + kZero};
}

std::pair<double, double> speedRange(const Snapshot& snapshot) {
  float fastest = 0.05f;  // m/s; slower than that everything counts as at rest
  for (const float speed : snapshot.speed) fastest = std::max(fastest, speed);
  return {0, roundUp(fastest)};
}

template <int kLow, int kHigh, int kParts>
std::pair<double, double> fixedRange(const Snapshot&) {
  return {1.0 * kLow / kParts, 1.0 * kHigh / kParts};
}

template <auto kField>
float valueOf(const Snapshot& snapshot, size_t particle) {
  return static_cast<float>((snapshot.*kField)[particle]);
}

constexpr Colouring kColourings[] = {
    {ColourBy::Material, "material", nullptr, fixedRange<0, 1, 1>, false, true},
    {ColourBy::Temperature, "temperature", valueOf<&Snapshot::temperature>, temperatureRange, true, true},
    {ColourBy::Phase, "phase", valueOf<&Snapshot::phase>, fixedRange<0, 4, 1>, false, true},
    {ColourBy::Speed, "speed", valueOf<&Snapshot::speed>, speedRange, true, true},
    // A surface would hide where inside of it the density is wrong.
    {ColourBy::DensityError, "density_error", valueOf<&Snapshot::densityError>, fixedRange<-5, 5, 100>, true, false},
};

}  // namespace

std::span<const Colouring> colourings() { return kColourings; }

const Colouring& colouringOf(ColourBy colour) {
  return *std::find_if(std::begin(kColourings), std::end(kColourings) - 1,
                       [&](const Colouring& row) { return row.colour == colour; });
}

ColourBy colourByName(const std::string& name) {
  for (const Colouring& row : kColourings)
    if (name == row.name) return row.colour;
  return ColourBy::Material;
}

const char* colourName(ColourBy colour) { return colouringOf(colour).name; }

std::pair<double, double> colourRange(const Snapshot& snapshot, ColourBy colour) {
  return colouringOf(colour).range(snapshot);
}

std::array<float, 3> colourAt(ColourBy colour, double t, double pivot) {
  const auto found = maps().byName.find(colourName(colour));
  if (found == maps().byName.end()) return {0.5f, 0.5f, 0.5f};
  if (colour == ColourBy::Temperature) {
    const double fixed = maps().temperaturePivot;
    // Each side of the melting point is linear up to its own end, also where that lies outside the range.
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

ColourTable::ColourTable(ColourBy colour, double minimum, double maximum, double meltingPoint)
    : m_minimum(static_cast<float>(minimum)), m_scale(static_cast<float>(1 / std::max(maximum - minimum, 1e-12))) {
  const double pivot = (meltingPoint - minimum) / std::max(maximum - minimum, 1e-12);
  if (colour == ColourBy::Material) return;  // has no map
  for (size_t i = 0; i < m_samples.size(); ++i)
    m_samples[i] = colourAt(colour, static_cast<double>(i) / static_cast<double>(m_samples.size() - 1), pivot);
}

const Colour& ColourTable::at(float value) const {
  const float t = std::clamp((value - m_minimum) * m_scale, 0.f, 1.f);
  return m_samples[static_cast<size_t>(t * static_cast<float>(m_samples.size() - 1) + 0.5f)];
}

}  // namespace render
}  // namespace ps
