// SPDX-License-Identifier: Apache-2.0
#include "clustershape.h"

namespace ps::constraint {

using Model = ClusterModel;

/// rad: far below what single-precision places can tell.
constexpr double kExact = 1e-9;

ClusterShape::ClusterShape(const api::ParticleView& particles, const api::GroupBatch& batch, size_t group)
    : m_p(particles), m_batch(batch), m_group(group), m_first(batch.begin[group]), m_last(batch.begin[group + 1]) {
  const auto value = [&](Model::Value v) { return double{batch.values[v][group]}; };
  m_rotation = normalised(
      {value(Model::kRotationX), value(Model::kRotationY), value(Model::kRotationZ), value(Model::kRotationW)});
}

void ClusterShape::fit(const uint8_t* without) {
  // Sums over places seen from a member, so that nothing large cancels; moments about the centres follow from them.
  const Vector origin = vectorOf(m_p.position[m_batch.particles[m_first]]);
  double total = 0;
  Vector place, restPlace;
  Matrix moments;
  each(without, [&](size_t k) {
    const double m = mass(k);
    const Vector r = rest(k), weighted = m * (vectorOf(m_p.position[m_batch.particles[k]]) - origin);
    total += m;
    restPlace += m * r;
    place += weighted;
    addOuter(moments, 1, weighted, r);
  });
  m_restCentre = 1 / total * restPlace;
  addOuter(moments, -1, place, m_restCentre);
  m_centre = origin + 1 / total * place;
  m_rotation = rotationOf(moments, m_rotation, kExact);
  const double parts[] = {m_rotation.x, m_rotation.y, m_rotation.z, m_rotation.w};
  for (size_t v = 0; v < 4; ++v) m_batch.values[Model::kRotationX + v][m_group] = static_cast<float>(parts[v]);
  m_turned = matrixOf(m_rotation);
  for (Vector& row : m_turned.row) row = double{m_batch.values[Model::kScale][m_group]} * row;
}

namespace {

/// Masses m_k at x_k: their centre and the inertia about it.
struct Spread {
  double mass = 0;
  Vector centre;
  Matrix inertia;
};

template <class MassOf, class PlaceOf>
Spread spreadOf(size_t first, size_t last, MassOf&& massOf, PlaceOf&& placeOf) {
  Spread s;
  for (size_t k = first; k < last; ++k) {
    s.mass += massOf(k);
    s.centre += massOf(k) * placeOf(k);
  }
  s.centre = 1 / s.mass * s.centre;
  for (size_t k = first; k < last; ++k) {
    const Vector arm = placeOf(k) - s.centre;
    const double m = massOf(k), arm2 = dot(arm, arm);
    addOuter(s.inertia, -m, arm, arm);
    s.inertia.row[0].x += m * arm2, s.inertia.row[1].y += m * arm2, s.inertia.row[2].z += m * arm2;
  }
  return s;
}

}  // namespace

void ClusterShape::findDeformation(std::vector<Vector>& change) const {
  const auto place = [&](size_t k) { return vectorOf(m_p.position[m_batch.particles[k]]); };
  const Spread spread = spreadOf(
      m_first, m_last, [&](size_t k) { return mass(k); }, place);
  change.clear();
  Vector shift, turning;
  for (size_t k = m_first; k < m_last; ++k) {
    const Vector way = place(k) - vectorOf(m_p.previous[m_batch.particles[k]]);
    change.push_back(way);
    shift += mass(k) * way;
    turning += mass(k) * cross(place(k) - spread.centre, way);
  }
  shift = 1 / spread.mass * shift;
  turning = symmetricInverse(spread.inertia) * turning;
  for (size_t k = m_first; k < m_last; ++k) {
    Vector& way = change[k - m_first];
    way = way - shift - cross(turning, place(k) - spread.centre);
  }
}

void ClusterShape::turn(Vector angular, api::Float4* velocity) const {
  const auto place = [&](size_t k) { return vectorOf(m_p.position[m_batch.particles[k]]); };
  const Spread spread = spreadOf(
      m_first, m_last, [&](size_t k) { return mass(k); }, place);
  const Vector spin = symmetricInverse(spread.inertia) * angular;
  for (size_t k = m_first; k < m_last; ++k) {
    api::Float4& v = velocity[m_batch.particles[k]];
    setVector(v, vectorOf(v) + cross(spin, place(k) - spread.centre));
  }
}

Vector ClusterShape::meanVelocity(const uint8_t* without) const {
  double total = 0;
  Vector sum;
  each(without, [&](size_t k) {
    total += mass(k);
    sum += mass(k) * vectorOf(m_p.velocity[m_batch.particles[k]]);
  });
  return 1 / total * sum;
}

double ClusterShape::scaleOfVolumes() const {
  double now = 0, then = 0;
  for (size_t k = m_first; k < m_last; ++k) {
    now += double{m_p.position[m_batch.particles[k]].w};
    then += double{m_batch.memberValues[Model::kRestVolume][k]};
  }
  return then > 0 ? cubeRoot(now / then) : 1;
}

double ClusterShape::restMoment() const {
  double total = 0, moment = 0;
  Vector centre;
  for (size_t k = m_first; k < m_last; ++k) {
    total += mass(k);
    centre += mass(k) * rest(k);
  }
  centre = 1 / total * centre;
  for (size_t k = m_first; k < m_last; ++k) {
    const Vector arm = rest(k) - centre;
    moment += mass(k) * dot(arm, arm) / 3;
  }
  return moment;
}

}  // namespace ps::constraint
