// SPDX-License-Identifier: Apache-2.0
#include "core/simulation/measure.h"

#include "core/base/parallel.h"
#include "core/particles/colourfield.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ps {
namespace {

double kineticEnergy(const ParticleStore& store) {
  return parallelSum(store.size(), grain::kNumbers, [&](size_t first, size_t last) {
    double sum = 0;
    for (size_t i = first; i < last; ++i) {
      if (store.velocity()[i].w > 0) sum += 0.5 * store.mass()[i] * squaredSpeed(store.velocity()[i]);
    }
    return sum;
  });
}

/// Mass, weighted mean, smallest and largest of a quantity over the particles that a probe sees.
struct Tally {
  double mass = 0, sum = 0;
  double smallest = std::numeric_limits<double>::infinity(), largest = -smallest;
  uint64_t count = 0;
  void add(double weight, double value) {
    mass += weight;
    sum += weight * value;
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
    ++count;
  }
};

}  // namespace

FrameStats measure(const Solver& solver, const StepReport& report) {
  const ParticleStore& store = solver.particles();
  FrameStats stats;
  stats.frame = solver.frame();
  stats.time = solver.time();
  stats.thermalTime = solver.thermalTime();
  Tally temperature;
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.velocity()[i].w == 0) continue;
    PhaseAmount& amount = stats.phases[static_cast<size_t>(store.phase()[i])];
    ++amount.count;
    amount.mass += store.mass()[i];
    temperature.add(store.mass()[i], store.temperature()[i]);
  }
  if (temperature.count == 0) {  // what is fixed has a temperature too
    for (size_t i = 0; i < store.size(); ++i) temperature.add(store.mass()[i], store.temperature()[i]);
  }
  if (temperature.count) {
    stats.temperatureMin = temperature.smallest;
    stats.temperatureMean = temperature.sum / temperature.mass;
    stats.temperatureMax = temperature.largest;
  }
  stats.densityErrorMean = report.densityErrorMean;
  stats.densityErrorMax = report.densityErrorMax;
  stats.thermalEnergy = solver.thermalEnergy();
  stats.kineticEnergy = kineticEnergy(store);
  stats.heat = solver.heatLedger();
  stats.momentum = report.momentum;
  stats.milliseconds = report.milliseconds;
  stats.totalMilliseconds = report.totalMilliseconds;
  return stats;
}

void fillSnapshot(Snapshot& snapshot, const Solver& solver, std::span<const FieldPtr> shown) {
  const ParticleStore& store = solver.particles();
  const size_t n = store.size();
  snapshot.period = store.period();
  snapshot.position.resize(n);
  snapshot.temperature.resize(n);
  snapshot.speed.resize(n);
  snapshot.densityError.assign(store.densityError(), store.densityError() + n);
  snapshot.gasFraction.assign(store.gasFraction(), store.gasFraction() + n);
  snapshot.phase.assign(store.phase(), store.phase() + n);
  snapshot.motion.assign(store.motion(), store.motion() + n);
  snapshot.id.assign(store.id(), store.id() + n);
  snapshot.body.assign(store.body(), store.body() + n);
  snapshot.material.assign(store.material(), store.material() + n);
  if (const void* colours = store.read(kColourField, api::FieldType::UInt32)) {
    const auto* first = static_cast<const uint32_t*>(colours);
    if (std::any_of(first, first + n, [](uint32_t colour) { return colour != 0; }))
      snapshot.colour.assign(first, first + n);
  }
  for (size_t i = 0; i < n; ++i) {
    const api::Double3 p = store.wrappedPosition(i);
    const float volume = store.position()[i].w;
    snapshot.position[i] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                            std::cbrt(volume * 0.75f / std::numbers::pi_v<float>)};
    snapshot.temperature[i] = static_cast<float>(store.temperature()[i]);
    snapshot.speed[i] = static_cast<float>(std::sqrt(squaredSpeed(store.velocity()[i])));
  }
  for (const FieldPtr& field : shown) {
    const StoredField stored(*field, store);
    if (!stored || field->inSnapshot) continue;
    std::vector<float>& values = snapshot.fields.emplace_back(FieldValues{field, std::vector<float>(n)}).values;
    for (size_t i = 0; i < n; ++i) values[i] = static_cast<float>(stored[i]);
  }
}

}  // namespace ps
