// SPDX-License-Identifier: Apache-2.0
#include "clustershape.h"

#include "rotationkernels.h"

namespace ps::constraint {

using Model = ClusterModel;

/// rad: far below what single-precision places can tell.
constexpr double kExact = 1e-9;

namespace {

Quaternion rotationOf(const api::GroupBatch& batch, size_t group) {
  const auto value = [&](Model::Value v) { return double{batch.values[v][group]}; };
  return normalised(
      {value(Model::kRotationX), value(Model::kRotationY), value(Model::kRotationZ), value(Model::kRotationW)});
}

void keepRotation(const api::GroupBatch& batch, size_t group, Quaternion q) {
  const double parts[] = {q.x, q.y, q.z, q.w};
  for (size_t v = 0; v < 4; ++v) batch.values[Model::kRotationX + v][group] = static_cast<float>(parts[v]);
}

Matrix turnedBy(const api::GroupBatch& batch, size_t group, Quaternion q) {
  Matrix turned = matrixOf(q);
  for (Vector& row : turned.row) row = double{batch.values[Model::kScale][group]} * row;
  return turned;
}

/// About the centres.
Matrix momentsOf(const ClusterSums& sums, Vector restCentre) {
  Matrix moments = sums.moments;
  addOuter(moments, -1, sums.place, restCentre);
  return moments;
}

}  // namespace

void ClusterFits::find(const api::GroupBatch& batch, const size_t* group, const ClusterSums* sums, size_t count) {
  std::array<Quaternion, kMost> rotation;
  std::array<Matrix, kMost> moments;
  for (size_t k = 0; k < count; ++k) {
    m_restCentre[k] = 1 / sums[k].mass * sums[k].rest;
    moments[k] = momentsOf(sums[k], m_restCentre[k]);
    rotation[k] = rotationOf(batch, group[k]);
  }
  findRotations(moments.data(), rotation.data(), count, kExact);
  for (size_t k = 0; k < count; ++k) {
    keepRotation(batch, group[k], rotation[k]);
    m_turned[k] = turnedBy(batch, group[k], rotation[k]);
  }
}

ClusterShape::ClusterShape(const api::ParticleView& particles, const api::GroupBatch& batch, size_t group)
    : m_p(particles),
      m_batch(batch),
      m_group(group),
      m_first(batch.begin[group]),
      m_last(batch.begin[group + 1]),
      m_rotation(rotationOf(batch, group)) {}

void ClusterShape::fit(const uint8_t* without) {
  // Sums over places seen from a member, so that nothing large cancels; moments about the centres follow from them.
  ClusterSums sums;
  sums.origin = vectorOf(m_p.position[m_batch.particles[m_first]]);
  each(without, [&](size_t k) {
    const double m = mass(k);
    const Vector r = rest(k), weighted = m * (vectorOf(m_p.position[m_batch.particles[k]]) - sums.origin);
    sums.mass += m;
    sums.rest += m * r;
    sums.place += weighted;
    addOuter(sums.moments, 1, weighted, r);
  });
  m_restCentre = 1 / sums.mass * sums.rest;
  m_centre = sums.origin + sums.centre();
  m_rotation = constraint::rotationOf(momentsOf(sums, m_restCentre), m_rotation, kExact);
  keepRotation(m_batch, m_group, m_rotation);
  m_turned = turnedBy(m_batch, m_group, m_rotation);
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
