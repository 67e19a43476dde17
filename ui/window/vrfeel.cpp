// SPDX-License-Identifier: Apache-2.0
#include "ui/window/vrfeel.h"

#include "core/math/vector.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ps {
namespace {

// Felt at 63 % of what a controller can.
constexpr double kFirm = 5;                                           // N
constexpr double kSteep = 1000;                                       // K/m: ten kelvin over a centimetre
constexpr double kTaken = 20;                                         // W
constexpr double kChanging = 0.25;                                    // of the matter under a brush
constexpr double kForceTone = 80, kHeatTone = 40, kLatentTone = 160;  // Hz
constexpr size_t kLeast = 5;                                          // particles that have a plane of temperatures
constexpr double kFlat = 1e-3;  // spread of matter along an axis, of that along all, below which it says nothing

double felt(double much, double clear) { return 1 - std::exp(-std::abs(much) / clear); }

/// Calls use(offset from the place in m, volume, index) for what is there.
template <class Use>
void each(const Snapshot& scene, const Vector3& place, double radius, Use use) {
  for (size_t i = 0; i < scene.position.size(); ++i) {
    const api::Float4& p = scene.position[i];
    const Vector3 offset = vectorOf(p) - place;
    const double own = double{p.w};
    if (offset.squaredNorm() < radius * radius) use(offset, own * own * own, i);
  }
}

}  // namespace

double steepnessAt(const Snapshot& scene, const Vector3& place, double radius) {
  size_t count = 0;
  double weight = 0, warmth = 0;
  Vector3 middle = Vector3::Zero();
  each(scene, place, radius, [&](const Vector3& offset, double volume, size_t i) {
    ++count;
    weight += volume;
    middle += volume * offset;
    warmth += volume * double{scene.temperature[i]};
  });
  if (count < kLeast || !(weight > 0)) return 0;
  middle /= weight;
  warmth /= weight;
  Matrix3 spread = Matrix3::Zero();
  Vector3 rise = Vector3::Zero();
  each(scene, place, radius, [&](const Vector3& offset, double volume, size_t i) {
    const Vector3 from = offset - middle;
    spread += volume / weight * from * from.transpose();
    rise += volume / weight * (double{scene.temperature[i]} - warmth) * from;
  });
  // Across a thin sheet nothing is known: there the plane is level.
  spread += kFlat * spread.trace() * Matrix3::Identity();
  if (!(spread.trace() > 0)) return 0;
  const Vector3 slope = spread.inverse() * rise;
  return slope.norm();
}

double changingAt(const Snapshot& scene, const Vector3& place, double radius) {
  double all = 0, changing = 0;
  each(scene, place, radius, [&](const Vector3&, double volume, size_t i) {
    all += volume;
    if (scene.phase[i] == api::Phase::Melting || scene.phase[i] == api::Phase::Boiling) changing += volume;
  });
  return all > 0 ? changing / all : 0;
}

vr::Feeling stronger(const vr::Feeling& a, const vr::Feeling& b) { return b.strength > a.strength ? b : a; }

vr::Feeling feelingOfEffort(double effort) { return {felt(effort, kFirm), kForceTone}; }

vr::Feeling feelingOf(const ToolContact& contact) {
  const vr::Feeling force = feelingOfEffort(contact.force.norm());
  const vr::Feeling heat{felt(contact.gradient, kSteep), kHeatTone}, latent{felt(contact.latent, kTaken), kLatentTone};
  return stronger(stronger(force, heat), latent);
}

vr::Feeling feelingOf(const Snapshot& scene, const Vector3& place, double radius) {
  return stronger({felt(steepnessAt(scene, place, radius), kSteep), kHeatTone},
                  {felt(changingAt(scene, place, radius), kChanging), kLatentTone});
}

}  // namespace ps
