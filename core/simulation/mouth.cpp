// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/mouth.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace ps {
namespace {

/// Spacings between layers from which on they do not press each other apart.
constexpr double kLeastPitch = 0.9;
/// A place on the rim is in.
constexpr double kRim = 1e-9;

/// Places of a lattice shifted by so many spacings, row by row, within `radius` spacings.
std::vector<std::array<double, 2>> placesWithin(double radius, double row, double column) {
  std::vector<std::array<double, 2>> places;
  const int reach = static_cast<int>(std::floor(radius)) + 1;
  for (int r = -reach; r <= reach; ++r) {
    for (int c = -reach; c <= reach; ++c) {
      const double y = r + row, x = c + column;
      if (std::sqrt(x * x + y * y) <= radius + kRim) places.push_back({y, x});
    }
  }
  return places;
}

}  // namespace

Mouth mouthOf(double diameter, double spacing) {
  const double radius = diameter / 2 / spacing, area = std::numbers::pi * radius * radius;  // spacings
  Mouth best{{{0, 0}}, 1 / area};                                                           // in spacings
  // Layers that are too near come last; of the others those whose distance is nearest to a spacing come first.
  const auto isBetter = [](double pitch, double than) {
    if (pitch < kLeastPitch || than < kLeastPitch) return pitch > than;
    return std::abs(std::log(pitch)) < std::abs(std::log(than));
  };
  for (const auto& [row, column] : {std::array{0.0, 0.0}, std::array{0.5, 0.0}, std::array{0.5, 0.5}}) {
    std::vector<std::array<double, 2>> places = placesWithin(radius, row, column);
    const double pitch = static_cast<double>(places.size()) / area;
    if (!places.empty() && isBetter(pitch, best.pitch)) best = {std::move(places), pitch};
  }
  for (auto& place : best.places) place = {spacing * place[0], spacing * place[1]};
  best.pitch *= spacing;
  return best;
}

}  // namespace ps
