// SPDX-License-Identifier: Apache-2.0
#include "core/experiments/settlingmeasure.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ps {
namespace {

double length(const api::Double3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

}  // namespace

void SettlingMeasure::add(Engine& engine, const FrameStats& stats) {
  ++m_frames;
  m_end = stats.kineticEnergy;
  m_highest = std::max(m_highest, m_end);
  if (m_frames < m_half || m_half == 0) return;
  const ParticleStore& store = engine.particles();
  if (m_frames == m_half) {
    m_start = stats.time;
    for (size_t i = 0; i < store.size(); ++i) {
      const size_t id = store.id()[i];
      if (m_places.size() <= id) m_places.resize(id + 1);
      m_places[id] = {true, store.position()[i]};
    }
    return;
  }
  double mass = 0;
  for (const PhaseAmount& phase : stats.phases) mass += phase.mass;
  const double speed = mass > 0 ? std::sqrt(2 * m_end / mass) : 0;
  m_sum += m_end;
  m_speedSum += speed;
  m_speedHighest = std::max(m_speedHighest, speed);
}

nlohmann::json SettlingMeasure::json(Engine& engine) const {
  if (m_half == 0 || m_frames <= m_half) return nullptr;
  const ParticleStore& store = engine.particles();
  struct Centre {
    double mass = 0;
    api::Double3 moved;
  };
  std::map<uint32_t, Centre> bodies;
  double solid = 0;
  for (size_t i = 0; i < store.size(); ++i) {
    const size_t id = store.id()[i];
    if (store.motion()[i] == api::Motion::Static || id >= m_places.size() || !m_places[id].here) continue;
    const api::Float4 now = store.position()[i], then = m_places[id].position;
    float x = now.x - then.x, y = now.y - then.y, z = now.z - then.z;
    store.period().shorten(x, y, z);
    const api::Double3 moved{x, y, z};
    if (store.phase()[i] == api::Phase::Solid) solid = std::max(solid, length(moved));
    const double mass = store.mass()[i];
    Centre& centre = bodies[store.body()[i]];
    centre.mass += mass;
    centre.moved = {centre.moved.x + mass * moved.x, centre.moved.y + mass * moved.y, centre.moved.z + mass * moved.z};
  }
  double farthest = 0;
  for (const auto& [body, centre] : bodies) farthest = std::max(farthest, length(centre.moved) / centre.mass);
  const auto watched = static_cast<double>(m_frames - m_half);
  return {{"from_s", m_start},
          {"kinetic_energy", {{"highest", m_highest}, {"mean", m_sum / watched}, {"end", m_end}}},
          {"speed_rms", {{"mean", m_speedSum / watched}, {"highest", m_speedHighest}}},
          {"moved", {{"body", farthest}, {"solid_particle", solid}}}};
}

}  // namespace ps
