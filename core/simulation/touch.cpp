// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/touch.h"

#include "core/simulation/engine.h"
#include "core/simulation/lattice.h"
#include "core/solver/solver.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ps {
namespace {

constexpr double kStrongest = 1e15;                 // W, N
constexpr double kColdest = 1, kHottest = 1e4;      // K
constexpr double kFastest = 100, kQuickest = 1000;  // m/s, rad/s

bool isFinite(const api::Double3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// 1 in the middle of a ball, 0 from its rim on; in between a cubic that is level at both ends of the falloff.
double weightOf(const api::Touch& touch, double distance) {
  const double faded = touch.falloff * touch.radius;
  if (!(faded > 0)) return 1;
  const double t = std::min(1.0, (touch.radius - distance) / faded);
  return t * t * (3 - 2 * t);
}

/// J that a particle surely takes, or gives, before it is at a temperature: where a plateau or a phase of more capacity
/// lies between it takes more, in the frames to come.
double untilAt(const Engine& engine, size_t row, double temperature) {
  const ParticleStore& store = engine.particles();
  const api::Caloric& c = engine.solver().materials()[store.material()[row]].caloric();
  const double capacity = std::min({c.heatCapacitySolid, c.heatCapacityLiquid, c.heatCapacityGas});
  return store.mass()[row] * capacity * (temperature - store.temperature()[row]);
}

}  // namespace

Vector3 offsetOf(const ParticleStore& store, size_t row, const api::Double3& centre) {
  const api::Float4& p = store.position()[row];
  api::Float4 offset = float4Of(Vector3(p.x - centre.x, p.y - centre.y, p.z - centre.z), 0);
  store.period().shorten(offset.x, offset.y, offset.z);
  return vectorOf(offset);
}

std::string contactOf(uint64_t key) { return "hand " + std::to_string(key); }

bool canBe(const api::Touch& touch) {
  const bool place = isFinite(touch.centre) && std::isfinite(touch.radius) && touch.radius > 0 && touch.falloff >= 0 &&
                     touch.falloff <= 1;
  const bool heat = std::abs(touch.power) <= kStrongest &&
                    (touch.kind != api::TouchKind::Heat || (touch.limit >= kColdest && touch.limit <= kHottest));
  const bool motion = touch.force >= 0 && touch.force <= kStrongest && vectorOf(touch.velocity).norm() <= kFastest &&
                      vectorOf(touch.spin).norm() <= kQuickest;
  const double normal = vectorOf(touch.normal).norm();
  const bool blade = normal == 0 || (touch.kind == api::TouchKind::Cut && std::abs(normal - 1) < 1e-6);
  return touch.kind <= api::TouchKind::Weld && place && heat && motion && blade;
}

Reachable reachable(const Engine& engine, std::span<const api::Touch> touches, std::vector<uint8_t> isSpared) {
  std::vector<api::Double3> places;
  double radius = 0;
  for (const api::Touch& touch : touches) {
    places.push_back(touch.centre);
    radius = std::max(radius, touch.radius);
  }
  constexpr double kRounding = 1.001;  // offsets are known in single precision
  return {rowsNear(engine.particles(), places, kRounding * radius), std::move(isSpared)};
}

Reached reach(const Engine& engine, const api::Touch& touch, const Reachable& among) {
  const ParticleStore& store = engine.particles();
  const std::vector<uint8_t>& isSpared = among.isSpared;
  const bool moves = touch.kind != api::TouchKind::Heat;
  Reached reached;
  for (const uint32_t i : among.rows) {
    if (store.body()[i] < isSpared.size() && isSpared[store.body()[i]]) continue;
    if (moves && store.velocity()[i].w == 0) continue;
    const double distance = offsetOf(store, i, touch.centre).norm();
    if (!(distance < touch.radius)) continue;
    reached.rows.push_back(i);
    reached.weights.push_back(weightOf(touch, distance) * store.mass()[i]);
    reached.total += reached.weights.back();
  }
  return reached;
}

std::vector<uint8_t> flagged(const Engine& engine, const std::vector<std::string>& bodies) {
  std::vector<uint8_t> flags(engine.bodyIds().size());
  for (size_t b = 0; b < flags.size(); ++b)
    flags[b] = std::find(bodies.begin(), bodies.end(), engine.bodyIds()[b]) != bodies.end() ? 1 : 0;
  return flags;
}

void addHeat(const Engine& engine, const api::Touch& touch, double seconds, const Reachable& among,
             std::vector<double>& joules) {
  const Reached reached = reach(engine, touch, among);
  for (size_t k = 0; k < reached.rows.size(); ++k) {
    const uint32_t row = reached.rows[k];
    const double wanted = touch.power * seconds * reached.weights[k] / reached.total;
    const double room = untilAt(engine, row, touch.limit) - joules[row];
    joules[row] +=
        wanted > 0 ? std::clamp(wanted, 0.0, std::max(0.0, room)) : std::clamp(wanted, std::min(0.0, room), 0.0);
  }
}

void addPush(const Engine& engine, const api::Touch& touch, double seconds, const Reachable& among,
             std::vector<Vector3>& change) {
  const ParticleStore& store = engine.particles();
  const Reached reached = reach(engine, touch, among);
  for (size_t k = 0; k < reached.rows.size(); ++k) {
    const uint32_t row = reached.rows[k];
    const Vector3 wanted = vectorOf(touch.velocity) + vectorOf(touch.spin).cross(offsetOf(store, row, touch.centre));
    const double most = touch.force * seconds * reached.weights[k] / (reached.total * store.mass()[row]);
    change[row] += atMost(wanted - vectorOf(store.velocity()[row]) - change[row], most);
  }
}

Vector3 atMost(const Vector3& change, double most) {
  const double length = change.norm();
  return length > most ? Vector3(change * (most / length)) : change;
}

}  // namespace ps
