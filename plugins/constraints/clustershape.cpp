// SPDX-License-Identifier: Apache-2.0
#include "clustershape.h"

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

/// The two parts of a number that one float does not hold.
double wholeOf(const api::GroupBatch& batch, Model::Value v, size_t group) {
  return double{batch.values[v][group]} + double{batch.values[v + 1][group]};
}
void keepWhole(const api::GroupBatch& batch, Model::Value v, size_t group, double number) {
  const auto most = static_cast<float>(number);
  batch.values[v][group] = most;
  batch.values[v + 1][group] = static_cast<float>(number - double{most});
}

constexpr Model::Value kRestCentre[3] = {Model::kRestCentreX, Model::kRestCentreY, Model::kRestCentreZ};

}  // namespace

double massOf(const api::GroupBatch& batch, size_t group) { return wholeOf(batch, Model::kMass, group); }

ClusterConstants ClusterConstants::find(const api::ParticleView& particles, const api::GroupBatch& batch,
                                        size_t group) {
  ClusterConstants found;
  Vector moment;
  for (size_t k = batch.begin[group]; k < batch.begin[group + 1]; ++k) {
    const uint32_t i = batch.particles[k];
    const auto rest = [&](Model::MemberValue v) { return double{batch.memberValues[v][k]}; };
    batch.memberValues[Model::kMemberMass][k] = particles.mass[i];
    const auto m = double{particles.mass[i]};
    found.mass += m;
    moment += m * Vector{rest(Model::kRestX), rest(Model::kRestY), rest(Model::kRestZ)};
    found.held = found.held || particles.velocity[i].w == 0;
  }
  found.restCentre = 1 / found.mass * moment;
  return found;
}

void ClusterConstants::keep(const api::GroupBatch& batch, size_t group) const {
  keepWhole(batch, Model::kMass, group, mass);
  const double centre[] = {restCentre.x, restCentre.y, restCentre.z};
  for (size_t a = 0; a < 3; ++a) keepWhole(batch, kRestCentre[a], group, centre[a]);
  batch.values[Model::kHeld][group] = held ? 1 : 0;
}

void ClusterFits::find(const api::GroupBatch& batch, size_t first, size_t count, const ClusterSums& sums) {
  ShapeFits& fits = m_fits;
  for (size_t k = 0; k < count; ++k) {
    const size_t group = first + k;
    m_mass[k] = massOf(batch, group);
    const double share = 1 / m_mass[k];
    for (size_t a = 0; a < 3; ++a) {
      fits.centre[a][k] = share * sums.place[a][k];
      fits.restCentre[a][k] = wholeOf(batch, kRestCentre[a], group);
      for (size_t b = 0; b < 3; ++b) fits.moments[a][b][k] = share * sums.moments[a][b][k];
    }
    for (size_t v = 0; v < 4; ++v) fits.rotation[v][k] = double{batch.values[Model::kRotationX + v][group]};
    fits.scale[k] = double{batch.values[Model::kScale][group]};
  }
  fitShapes(fits, count, kExact);
  for (size_t v = 0; v < 4; ++v) {
    for (size_t k = 0; k < count; ++k)
      batch.values[Model::kRotationX + v][first + k] = static_cast<float>(fits.rotation[v][k]);
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
  const Vector origin = vectorOf(m_p.position[m_batch.particles[m_first]]);
  double total = 0;
  Vector place, rests;
  Matrix moments;
  each(without, [&](size_t k) {
    const double m = mass(k);
    const Vector r = rest(k), weighted = m * (vectorOf(m_p.position[m_batch.particles[k]]) - origin);
    total += m;
    rests += m * r;
    place += weighted;
    addOuter(moments, 1, weighted, r);
  });
  m_restCentre = 1 / total * rests;
  m_centre = origin + 1 / total * place;
  addOuter(moments, -1, place, m_restCentre);
  m_rotation = constraint::rotationOf(moments, m_rotation, kExact);
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
