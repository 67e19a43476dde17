// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/fixedshapes.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// How far beyond the support radius surfaces are noted, in spacings: as far as iterations move a particle.
constexpr double kBeyond = 0.5;
/// How far before one face the next one lies at least, in spacings: what is curved turns away by less.
constexpr double kBefore = 0.45;
constexpr double kInPlace = 1e-3;   ///< spacings
constexpr double kTouching = 1e-9;  ///< of a spacing

bool isFluid(api::Motion motion) { return motion == api::Motion::Liquid || motion == api::Motion::Gas; }

}  // namespace

const FixedShapes& FixedShapes::none() {
  static const FixedShapes nothing;
  return nothing;
}

void FixedShapes::configure(const SolverSettings& settings) {
  forget();
  m_spacing = settings.spacing;
  m_reach = (settings.supportRatio + kBeyond) * settings.spacing;
}

bool FixedShapes::isInPlace(const ParticleStore& store, const FixedShape& shape,
                            std::span<const uint32_t> particles) const {
  const auto* places = static_cast<const api::Float4*>(store.read(field::kShapePlace, api::FieldType::Float4));
  if (particles.empty() || !places || places[particles[0]].w != markOf(shape.stamp, particles.size())) return false;
  const double off2 = kInPlace * kInPlace * m_spacing * m_spacing;
  return std::all_of(particles.begin(), particles.end(), [&](uint32_t i) {
    const api::Float4& v = store.velocity()[i];
    return v.x == 0 && v.y == 0 && v.z == 0 &&
           (shape.pose.of(vectorOf(places[i])) - vectorOf(store.position()[i])).squaredNorm() < off2;
  });
}

void FixedShapes::refresh(const ParticleStore& store) {
  m_standing.clear();
  if (m_shapes.empty() || store.period().any()) return;
  m_particles.resize(m_shapes.size());
  for (std::vector<uint32_t>& particles : m_particles) particles.clear();
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (store.motion()[i] != api::Motion::Static) continue;
    for (size_t k = 0; k < m_shapes.size(); ++k) {
      if (m_shapes[k].body == store.body()[i]) m_particles[k].push_back(i);
    }
  }
  m_shaped.assign(store.size(), 0);
  for (size_t k = 0; k < m_shapes.size(); ++k) {
    const FixedShape& shape = m_shapes[k];
    if (!isInPlace(store, shape, m_particles[k])) continue;
    for (const uint32_t i : m_particles[k]) m_shaped[i] = 1;
    const Matrix3 axes = shape.pose.turn.toRotationMatrix();
    const Vector3 low = shape.surface->low(), high = shape.surface->high();
    const Vector3 middle = shape.pose.of((low + high) / 2), half = axes.cwiseAbs() * (high - low) / 2;
    m_standing.push_back({&shape, middle - half, middle + half});
  }
}

bool FixedShapes::nearest(const Vector3& place, double reach, std::span<const Plane> over, Face& face) const {
  bool found = false;
  for (const Standing& standing : m_standing) {
    const FixedShape& shape = *standing.shape;
    if (!((place - place.cwiseMax(standing.low).cwiseMin(standing.high)).squaredNorm() < reach * reach)) continue;
    const Quaternion back = shape.pose.turn.conjugate();
    const Vector3 own = back * (place - shape.pose.shift);
    std::array<Plane, kMost> turned;
    for (size_t k = 0; k < over.size(); ++k)
      turned[k] = {back * over[k].normal, over[k].offset - over[k].normal.dot(shape.pose.shift)};
    const auto hit = shape.surface->within(reach, own, std::span(turned).first(over.size()));
    if (!hit) continue;
    const double along = (own - hit->place).dot(hit->normal);
    const bool inside = over.empty() && shape.closed && along < 0;
    double distance = std::sqrt(hit->squared);
    reach = distance;
    Vector3 normal = hit->normal;
    if (distance > kTouching * m_spacing) normal = (inside ? -1 : 1) * (own - hit->place) / distance;
    normal = shape.pose.turn * normal;
    face = {{normal, normal.dot(shape.pose.of(hit->place))}, inside ? -distance : distance, shape.body};
    found = true;
  }
  return found;
}

size_t FixedShapes::facesAt(const Vector3& place, double reach, Faces& faces) const {
  std::array<Plane, kMost> over;
  size_t count = 0;
  while (count < kMost && nearest(place, reach, std::span(over).first(count), faces[count])) {
    over[count] = faces[count].plane;
    over[count].offset += kBefore * m_spacing;
    ++count;
  }
  return count;
}

void FixedShapes::findNear(const Vector3& place, size_t fluid, Near* near) {
  Faces faces;
  const size_t count = facesAt(place, m_reach, faces);
  m_clearance[fluid] = static_cast<float>(count > 0 ? faces[0].distance : m_reach);
  m_count[m_fluids[fluid]] = static_cast<uint8_t>(count);
  for (size_t k = 0; k < count; ++k) near[k] = {WallPlane(faces[k].plane), faces[k].body};
}

void FixedShapes::refreshLists(const ParticleStore& store, const Neighbours& neighbours, bool newLists) {
  if (!any()) {
    m_fluids.clear();
    m_stood.clear();
    return;
  }
  const api::Motion* motion = store.motion();
  const api::Float4* velocity = store.velocity();
  findIndices(store.size(), m_present, [&](size_t i) { return isFluid(motion[i]) && velocity[i].w > 0; });
  const bool same = std::equal(m_standing.begin(), m_standing.end(), m_stood.begin(), m_stood.end(),
                               [](const Standing& a, const Standing& b) { return a.shape == b.shape; });
  if (!newLists && same && m_present == m_fluids && m_count.size() == store.size()) return;
  m_stood = m_standing;
  m_fluids.swap(m_present);
  m_count.assign(store.size(), 0);
  m_begin.resize(store.size());
  m_clearance.resize(m_fluids.size());
  m_near.resize(kMost * m_fluids.size());
  const std::span<const api::Float4> built = neighbours.built();
  forChunks(m_fluids.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      m_begin[m_fluids[k]] = static_cast<uint32_t>(kMost * k);
      findNear(vectorOf(built[m_fluids[k]]), k, &m_near[kMost * k]);
    }
  });
}

}  // namespace ps
