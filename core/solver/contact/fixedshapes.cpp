// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/fixedshapes.h"

#include "core/base/parallelarrays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ps {
namespace {

/// How far beyond the support radius surfaces are noted, in spacings: as far as iterations move a particle.
constexpr double kBeyond = 0.5;
/// How far before one face the next one lies at least, in spacings: what is curved turns away by less.
constexpr double kBefore = 0.45;
constexpr double kInPlace = 1e-3;   ///< spacings
constexpr double kTouching = 1e-9;  ///< of a spacing

/// How far off the line of two particles a third one must lie to tell how a shape is turned, in spacings.
constexpr double kOffLine = 0.5;

const api::Float4* placesOf(const ParticleStore& store) {
  return static_cast<const api::Float4*>(store.read(field::kShapePlace, api::FieldType::Float4));
}

auto placesNow(const ParticleStore& store) {
  return [position = store.position()](uint32_t i) { return vectorOf(position[i]); };
}

bool isFluid(api::Motion motion) { return motion == api::Motion::Liquid || motion == api::Motion::Gas; }

}  // namespace

const FixedShapes& FixedShapes::none() {
  static const FixedShapes nothing;
  return nothing;
}

void FixedShapes::configure(const SolverSettings& settings) {
  forget();
  m_spacing = settings.spacing;
  m_step = settings.dt / settings.substeps;
  m_reach = (settings.supportRatio + kBeyond) * settings.spacing;
}

bool FixedShapes::isMarked(const ParticleStore& store, const FixedShape& shape,
                           std::span<const uint32_t> particles) const {
  const api::Float4* places = placesOf(store);
  return !particles.empty() && places && places[particles[0]].w == markOf(shape.stamp, particles.size());
}

/// Whether all particles are where the shape has them in this pose.
bool FixedShapes::fits(const ParticleStore& store, const RigidMove& pose, std::span<const uint32_t> particles) const {
  const api::Float4* places = placesOf(store);
  const double off2 = kInPlace * kInPlace * m_spacing * m_spacing;
  return std::all_of(particles.begin(), particles.end(), [&](uint32_t i) {
    return (pose.of(vectorOf(places[i])) - vectorOf(store.position()[i])).squaredNorm() < off2;
  });
}

/// The first particle, the one that is farthest from it, and the one that is farthest from the line through both.
bool FixedShapes::findMarks(const ParticleStore& store, std::span<const uint32_t> particles, Marks& marks) const {
  const api::Float4* places = placesOf(store);
  const Vector3 first = vectorOf(places[particles[0]]);
  const auto farthest = [&](auto&& square) {
    return *std::max_element(particles.begin(), particles.end(), [&](uint32_t i, uint32_t j) {
      return square(vectorOf(places[i]) - first) < square(vectorOf(places[j]) - first);
    });
  };
  const uint32_t second = farthest([](const Vector3& arm) { return arm.squaredNorm(); });
  const Vector3 line = (vectorOf(places[second]) - first).normalized();
  const auto offLine = [&](const Vector3& arm) { return arm.cross(line).squaredNorm(); };
  marks = {particles[0], second, farthest(offLine)};
  return offLine(vectorOf(places[marks[2]]) - first) > kOffLine * kOffLine * m_spacing * m_spacing;
}

/// Where a shape is by its marks, which are at placeOf(index).
template <class PlaceOf>
RigidMove FixedShapes::poseOf(const ParticleStore& store, const Marks& marks, const PlaceOf& placeOf) {
  const auto axesOf = [&](const auto& of) {
    const Vector3 first = of(marks[0]), along = (of(marks[1]) - first).normalized();
    const Vector3 across = along.cross(of(marks[2]) - first).normalized();
    Matrix3 axes;
    axes << along, across, along.cross(across);
    return axes;
  };
  const auto own = [places = placesOf(store)](uint32_t i) { return vectorOf(places[i]); };
  const Quaternion turn(axesOf(placeOf) * axesOf(own).transpose());
  return {turn.normalized(), placeOf(marks[0]) - turn * own(marks[0])};
}

bool FixedShapes::findPose(const ParticleStore& store, std::span<const uint32_t> particles, bool led,
                           Standing& standing) const {
  if (!isMarked(store, *standing.shape, particles)) return false;
  const bool rests = std::all_of(particles.begin(), particles.end(), [&](uint32_t i) {
    const api::Float4& v = store.velocity()[i];
    return v.x == 0 && v.y == 0 && v.z == 0;
  });
  standing.moves = !rests;
  standing.pose = standing.shape->pose;
  const bool inPlace = rests && fits(store, standing.pose, particles);
  if (!inPlace || led) standing.mayMove = findMarks(store, particles, standing.marks);
  if (inPlace) return true;
  if (!standing.mayMove) return false;
  standing.pose = poseOf(store, standing.marks, placesNow(store));
  return fits(store, standing.pose, particles);
}

void FixedShapes::setBox(Standing& standing) {
  const Matrix3 axes = standing.pose.turn.toRotationMatrix();
  const Vector3 low = standing.shape->surface->low(), high = standing.shape->surface->high();
  const Vector3 middle = standing.pose.of((low + high) / 2), half = axes.cwiseAbs() * (high - low) / 2;
  standing.low = middle - half;
  standing.high = middle + half;
}

void FixedShapes::refresh(const ParticleStore& store, bool led) {
  m_standing.clear();
  m_movers.clear();
  if (m_shapes.empty() || store.period().any()) return;
  m_particles.resize(m_shapes.size());
  for (std::vector<uint32_t>& particles : m_particles) particles.clear();
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (store.motion()[i] != api::Motion::Static) continue;
    for (size_t k = 0; k < m_shapes.size(); ++k) {
      if (m_shapes[k].body == store.body()[i]) m_particles[k].push_back(i);
    }
  }
  assignAll(m_shaped, store.size(), uint8_t{0});
  for (size_t k = 0; k < m_shapes.size(); ++k) {
    Standing standing;
    standing.shape = &m_shapes[k];
    if (!findPose(store, m_particles[k], led, standing)) continue;
    for (const uint32_t i : m_particles[k]) m_shaped[i] = 1;
    setBox(standing);
    standing.before = standing.pose;
    if (standing.moves && standing.mayMove) {  // wayOf() is asked before the first advance()
      standing.before = poseOf(store, standing.marks, [&](uint32_t i) {
        return Vector3(vectorOf(store.position()[i]) - m_step * vectorOf(store.velocity()[i]));
      });
    }
    standing.lowBefore = standing.low, standing.highBefore = standing.high;
    m_standing.push_back(standing);
  }
  findMovers();
}

void FixedShapes::findMovers() {
  m_movers.clear();
  for (uint32_t k = 0; k < m_standing.size(); ++k) {
    if (m_standing[k].moves) m_movers.push_back(k);
  }
}

void FixedShapes::advance(const ParticleStore& store) {
  bool started = false;
  double longest = 0;
  for (Standing& standing : m_standing) {
    if (!standing.mayMove) continue;
    standing.before = standing.pose;
    standing.lowBefore = standing.low, standing.highBefore = standing.high;
    const bool goes = std::any_of(standing.marks.begin(), standing.marks.end(), [&](uint32_t i) {
      const api::Float4 &to = store.position()[i], &from = store.previous()[i];
      return to.x != from.x || to.y != from.y || to.z != from.z;
    });
    if (!goes) continue;
    started = started || !standing.moves;
    standing.moves = true;
    standing.pose = poseOf(store, standing.marks, placesNow(store));
    setBox(standing);
    const Vector3 low = standing.shape->surface->low(), high = standing.shape->surface->high();
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 at(((corner & 1) != 0 ? high : low).x(), ((corner & 2) != 0 ? high : low).y(),
                       ((corner & 4) != 0 ? high : low).z());
      longest = std::max(longest, (standing.pose.of(at) - standing.before.of(at)).norm());
    }
  }
  if (started) findMovers();
  m_started = m_started || started;
  m_drift += longest;
  m_isNoted = m_isNoted && !moves();
}

bool FixedShapes::isBeside(uint32_t mover, const Vector3& from, const Vector3& to, double reach) const {
  const Standing& standing = m_standing[mover];
  const Vector3 low = standing.low.cwiseMin(standing.lowBefore), high = standing.high.cwiseMax(standing.highBefore);
  const auto within = [reach](const Vector3& least, const Vector3& most) { return (least - most).maxCoeff() < reach; };
  return within(low, from.cwiseMax(to)) && within(from.cwiseMin(to), high);
}

double FixedShapes::drift(size_t fluid, const Vector3& from, const Vector3& to, double reach) const {
  if (!moves() || m_beside[fluid] != 0) return m_drift;
  const bool beside =
      std::any_of(m_movers.begin(), m_movers.end(), [&](uint32_t mover) { return isBeside(mover, from, to, reach); });
  return beside ? std::numeric_limits<double>::infinity() : 0;
}

Vector3 FixedShapes::carried(uint32_t mover, const Vector3& place) const {
  const Standing& standing = m_standing[mover];
  return standing.pose.of(standing.before.inverse().of(place));
}

Vector3 FixedShapes::wayOf(uint32_t body, const Vector3& place) const {
  for (const uint32_t mover : m_movers) {
    const Standing& standing = m_standing[mover];
    if (standing.shape->body == body) return place - standing.before.of(standing.pose.inverse().of(place));
  }
  return Vector3::Zero();
}

bool FixedShapes::isMeant(const Standing& standing, int which) const {
  if (which == kAll) return true;
  return which == kStill ? !standing.moves : &standing == &m_standing[static_cast<size_t>(which)];
}

bool FixedShapes::nearest(const Vector3& place, double reach, std::span<const Plane> over, int which,
                          Face& face) const {
  bool found = false;
  for (const Standing& standing : m_standing) {
    if (!isMeant(standing, which)) continue;
    const FixedShape& shape = *standing.shape;
    const RigidMove& pose = standing.pose;
    if (!((place - place.cwiseMax(standing.low).cwiseMin(standing.high)).squaredNorm() < reach * reach)) continue;
    const Quaternion back = pose.turn.conjugate();
    const Vector3 own = back * (place - pose.shift);
    std::array<Plane, kMost> turned;
    for (size_t k = 0; k < over.size(); ++k)
      turned[k] = {back * over[k].normal, over[k].offset - over[k].normal.dot(pose.shift)};
    const auto hit = shape.surface->within(reach, own, std::span(turned).first(over.size()));
    if (!hit) continue;
    const double along = (own - hit->place).dot(hit->normal);
    const bool inside = over.empty() && shape.closed && along < 0;
    double distance = std::sqrt(hit->squared);
    reach = distance;
    Vector3 normal = hit->normal;
    if (distance > kTouching * m_spacing) normal = (inside ? -1 : 1) * (own - hit->place) / distance;
    normal = pose.turn * normal;
    face = {{normal, normal.dot(pose.of(hit->place))}, inside ? -distance : distance, shape.body};
    found = true;
  }
  return found;
}

size_t FixedShapes::facesAt(const Vector3& place, double reach, Faces& faces, int which) const {
  std::array<Plane, kMost> over;
  size_t count = 0;
  while (count < kMost && nearest(place, reach, std::span(over).first(count), which, faces[count])) {
    over[count] = faces[count].plane;
    over[count].offset += kBefore * m_spacing;
    ++count;
  }
  return count;
}

void FixedShapes::note(const ParticleStore& store, const Neighbours& neighbours, size_t fluid) {
  const uint32_t i = m_fluids[fluid];
  const Vector3 at = vectorOf(store.position()[i]);
  const bool beside =
      std::any_of(m_movers.begin(), m_movers.end(), [&](uint32_t mover) { return isBeside(mover, at, at, m_reach); });
  m_beside[fluid] = beside ? 1 : 0;
  m_noted[fluid] = beside ? at : vectorOf(neighbours.built()[i]);
  Faces faces;
  const size_t count = facesAt(m_noted[fluid], m_reach, faces, beside ? kAll : kStill);
  m_clearance[fluid] = static_cast<float>(count > 0 ? faces[0].distance : m_reach);
  m_count[i] = static_cast<uint8_t>(count);
  for (size_t k = 0; k < count; ++k) m_near[kMost * fluid + k] = {WallPlane(faces[k].plane), faces[k].body};
}

void FixedShapes::noteAll(const ParticleStore& store, const Neighbours& neighbours) {
  m_stood = m_standing;
  forChunks(m_fluids.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) note(store, neighbours, k);
  });
  m_drift = 0;
  m_started = false;
  m_isNoted = true;
}

void FixedShapes::follow(const ParticleStore& store, const Neighbours& neighbours) {
  if (!moves() || m_isNoted) return;
  if (m_started) return noteAll(store, neighbours);
  forChunks(m_fluids.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      const Vector3 at = vectorOf(store.position()[m_fluids[k]]);
      const auto beside = [&](uint32_t mover) { return isBeside(mover, at, at, m_reach); };
      if (m_beside[k] != 0 || std::any_of(m_movers.begin(), m_movers.end(), beside)) note(store, neighbours, k);
    }
  });
  m_drift = 0;
  m_isNoted = true;
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
  const bool same = !moves() && std::equal(m_standing.begin(), m_standing.end(), m_stood.begin(), m_stood.end(),
                                           [](const Standing& a, const Standing& b) {
                                             return a.shape == b.shape && a.moves == b.moves &&
                                                    a.pose.shift == b.pose.shift &&
                                                    a.pose.turn.coeffs() == b.pose.turn.coeffs();
                                           });
  if (!newLists && same && m_present == m_fluids && m_count.size() == store.size()) return;
  m_fluids.swap(m_present);
  assignAll(m_count, store.size(), uint8_t{0});
  m_begin.resize(store.size());
  for (size_t k = 0; k < m_fluids.size(); ++k) m_begin[m_fluids[k]] = static_cast<uint32_t>(kMost * k);
  m_clearance.resize(m_fluids.size());
  m_noted.resize(m_fluids.size());
  m_beside.resize(m_fluids.size());
  m_near.resize(kMost * m_fluids.size());
  noteAll(store, neighbours);
}

}  // namespace ps
