// SPDX-License-Identifier: Apache-2.0
#include "core/solver/frame/balance.h"

#include "core/base/parallel.h"

#include <Eigen/Geometry>

namespace ps {

Balance::Sums Balance::read(const ParticleStore& store, double perStep) {
  m_partial.resize(chunkCount(store.size(), grain::kParticles));
  forChunks(store.size(), grain::kParticles, [&](size_t first, size_t last) {
    Sums sums;
    for (size_t i = first; i < last; ++i) {
      if (store.velocity()[i].w == 0) continue;
      const double mass = store.mass()[i];
      const Vector3 place = vectorOf(store.position()[i]);
      const Vector3 velocity =
          perStep > 0 ? Vector3(perStep * (place - vectorOf(store.previous()[i]))) : vectorOf(store.velocity()[i]);
      sums.kinetic += 0.5 * mass * velocity.squaredNorm();
      sums.potential -= mass * m_gravity.dot(place);
      sums.angular += mass * place.cross(velocity);
    }
    m_partial[first / grain::kParticles] = sums;
  });
  Sums all;
  for (const Sums& sums : m_partial) {
    all.kinetic += sums.kinetic;
    all.potential += sums.potential;
    all.angular += sums.angular;
  }
  return all;
}

void Balance::begin(const ParticleStore& store, const Vector3& gravity) {
  m_record = {};
  if (!m_on) return;
  m_gravity = gravity;
  m_external.setZero();
  m_last = read(store, 0);
  m_record.measured = true;
  m_record.kineticStart = m_last.kinetic;
  m_record.potentialStart = m_last.potential;
  m_record.angularStart = double3Of(m_last.angular);
}

void Balance::mark(const ParticleStore& store, Part part, double perStep) {
  if (!m_on) return;
  const Sums now = read(store, perStep);
  m_record.given[static_cast<size_t>(part)] += (now.kinetic - m_last.kinetic) + (now.potential - m_last.potential);
  if (part == Part::Surroundings) m_external += now.angular - m_last.angular;
  m_last = now;
}

MechanicalRecord Balance::end(const Vector3& external) {
  if (!m_on) return {};
  m_record.kineticEnd = m_last.kinetic;
  m_record.potentialEnd = m_last.potential;
  m_record.angularEnd = double3Of(m_last.angular);
  m_record.angularExternal = double3Of(m_external + external);
  return m_record;
}

}  // namespace ps
