// SPDX-License-Identifier: Apache-2.0
// Which particles of rigid bodies may touch what, and how they face each other.
#include "core/base/statestream.h"
#include "core/solver/contact/rigidcontact.h"
#include "core/solver/contact/solidcontact.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Distances in spacings. Faces rest at one spacing; round contact as that of other solids.
constexpr double kFaceDistance = 1, kRoundDistance = 0.95;
/// How near to a wall the lists look for members: what turns, or is struck, is soon elsewhere.
constexpr double kWallReach = 4;
/// A face takes part as far beside a particle as half the diagonal of its lattice's squares reaches.
constexpr double kFaceWidth = 0.75;
constexpr double kOwnReach = 1.5;
/// Neighbours of the same lattice within that reach: 18 inside, 13 in a face, 9 on an edge, 6 in a corner.
constexpr uint32_t kFaceNeighbours = 11;
/// How far from one plane the neighbours in a layer one particle thick may lie, in spacings.
constexpr double kSheet = 0.3;
/// Least cosine between a face's normal and the line of centres.
constexpr double kFacing = 0.35;
/// Numbers of a contact that go on into the next frame.
constexpr size_t kCarried = 11;

}  // namespace

void RigidContact::configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                             std::span<const BakedMaterial> materials) {
  m_spacing = settings.spacing;
  // Slower than what gravity gives in two substeps nothing bounces, or a body at rest would hop.
  m_dt = settings.dt / settings.substeps;
  m_gravity = vectorOf(settings.gravity);
  m_slowest = 2 * m_gravity.norm() * m_dt;
  m_planes.clear();
  m_wallFriction.clear();
  for (const Wall& w : walls) {
    m_planes.push_back(planeOf(w, 0.5 * settings.spacing));
    m_wallFriction.push_back(w.friction);
  }
  m_materials.clear();
  for (const BakedMaterial& m : materials) {
    m_materials.push_back({m.scalar(propertyIndex("friction_static")), m.scalar(propertyIndex("friction_kinetic")),
                           m.scalar(propertyIndex("restitution"))});
  }
}

void RigidContact::refreshBodies(const ParticleStore& store, const ConstraintSystem& constraints) {
  m_isMember.assign(store.size(), 0);
  m_bodyOf.assign(store.size(), kNone);
  size_t count = 0;
  constraints.eachRigidGroup([&](std::span<const uint32_t> members) {
    for (const uint32_t i : members) m_isMember[i] = 1, m_bodyOf[i] = static_cast<uint32_t>(count);
    if (count == m_bodies.size()) m_bodies.emplace_back();
    Body body;
    body.members = std::move(m_bodies[count].members);  // their memory is used again
    body.members.assign(members.begin(), members.end());
    m_bodies[count++] = std::move(body);
  });
  m_bodies.resize(count);
}

void RigidContact::addContact(const ParticleStore& store, uint32_t i, uint32_t j) {
  const auto sideOf = [&](uint32_t p) {
    Side side{p, m_bodyOf[p]};
    if (side.body == kNone) side.inverseMass = store.velocity()[p].w;
    return side;
  };
  const auto rubOf = [&](uint32_t p) {
    return store.material()[p] < m_materials.size() ? m_materials[store.material()[p]] : Rub{0, 0, 0};
  };
  const Rub a = rubOf(i), b = rubOf(j);
  Contact c;
  c.a = sideOf(i), c.b = sideOf(j);
  c.key = uint64_t{store.id()[i]} << 32 | store.id()[j];
  c.staticFriction = 0.5 * (a.staticFriction + b.staticFriction);
  c.kineticFriction = 0.5 * (a.kineticFriction + b.kineticFriction);
  c.restitution = std::max(a.bounce, b.bounce);
  m_contacts.push_back(c);
}

void RigidContact::addPlane(const ParticleStore& store, uint32_t i, size_t plane) {
  Contact c;
  c.a = {i, m_bodyOf[i]};
  c.plane = static_cast<uint32_t>(plane);
  c.key = uint64_t{store.id()[i]} << 32 | (kNone - plane);
  c.normal = m_planes[plane].normal;
  c.distance = m_planes[plane].offset;
  c.staticFriction = c.kineticFriction = m_wallFriction[plane];
  if (store.material()[i] < m_materials.size()) c.restitution = m_materials[store.material()[i]].bounce;
  m_contacts.push_back(c);
}

/// What a contact carries on, but for its marks.
template <class AContact, class Visit>
void RigidContact::eachNumber(AContact& contact, Visit&& visit) {
  visit(contact.push), visit(contact.approach);
  for (auto* v : {&contact.rub, &contact.drift, &contact.left}) {
    for (auto& c : *v) visit(c);
  }
}

void RigidContact::save(StateWriter& writer) const {
  writer.open("rigid/keys", StateType::UInt64, m_contacts.size());
  for (const Contact& c : m_contacts) writer.put(c.key);
  writer.close();
  writer.open("rigid/numbers", StateType::Float64, kCarried * m_contacts.size());
  for (const Contact& c : m_contacts) eachNumber(c, [&](const double& number) { writer.put(number); });
  writer.close();
  writer.open("rigid/marks", StateType::UInt8, m_contacts.size());
  for (const Contact& c : m_contacts)
    writer.put(static_cast<uint8_t>((c.met ? 1 : 0) | (c.slides ? 2 : 0) | (c.yields ? 4 : 0)));
  writer.close();
}

void RigidContact::restore(const StateReader& reader) {
  const std::vector<uint64_t> keys = reader.array<uint64_t>("rigid/keys");
  const std::vector<uint8_t> marks = reader.array<uint8_t>("rigid/marks", keys.size(), 1);
  StateRuns<double> numbers(reader, "rigid/numbers");
  m_bodies.clear();
  m_contacts.assign(keys.size(), {});
  for (size_t k = 0; k < keys.size(); ++k) {
    Contact& c = m_contacts[k];
    c.key = keys[k];
    eachNumber(c, [&](double& number) { number = numbers.next(1)[0]; });
    c.met = (marks[k] & 1) != 0, c.slides = (marks[k] & 2) != 0, c.yields = (marks[k] & 4) != 0;
  }
  numbers.done();
}

/// New lists find most contacts again: what they bore goes on.
void RigidContact::keepImpulses() {
  const auto before = [](const Contact& a, const Contact& b) { return a.key < b.key; };
  std::sort(m_former.begin(), m_former.end(), before);
  for (Contact& c : m_contacts) {
    const auto found = std::lower_bound(m_former.begin(), m_former.end(), c, before);
    if (found == m_former.end() || found->key != c.key) continue;
    c.push = found->push, c.rub = found->rub, c.approach = found->approach;
    c.drift = found->drift, c.left = found->left;
    c.met = found->met, c.slides = found->slides, c.yields = found->yields;
  }
}

void RigidContact::refreshContacts(const ParticleStore& store, const Neighbours& neighbours,
                                   ConstraintSystem& constraints) {
  m_former.swap(m_contacts);
  m_contacts.clear();
  m_own.clear();
  m_ownBegin.assign(1, 0);
  if (m_bodies.empty()) return m_former.clear();
  m_ownOf.assign(store.size(), kNone);
  for (Body& body : m_bodies) body.hasContacts = false;
  const StructureGraph& graph = constraints.graph(store.size());
  const api::NeighbourView view = neighbours.view();
  const api::Motion* motion = store.motion();
  const double skin = kSkinSpacings * m_spacing, reach = std::hypot(kFaceDistance, kFaceWidth) * m_spacing + skin;
  // Where they were when the lists were made, not where they are: what is found then depends on nothing else.
  const std::span<const api::Float4> at = neighbours.built();
  const auto distance2 = [&](uint32_t i, uint32_t j) {
    float x = at[i].x - at[j].x, y = at[i].y - at[j].y, z = at[i].z - at[j].z;
    store.period().shorten(x, y, z);
    return Vector3(x, y, z).squaredNorm();
  };
  const auto needSurface = [&](uint32_t i) {
    if (m_ownOf[i] != kNone) return;
    m_ownOf[i] = static_cast<uint32_t>(m_ownBegin.size() - 1);
    const double own = kOwnReach * m_spacing;
    for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
      const uint32_t j = view.index[q];
      const bool same = m_bodyOf[i] != kNone ? m_bodyOf[j] == m_bodyOf[i]
                                             : motion[i] == api::Motion::Static && motion[j] == api::Motion::Static;
      if (same && distance2(i, j) < own * own) m_own.push_back(j);
    }
    m_ownBegin.push_back(static_cast<uint32_t>(m_own.size()));
  };
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (m_isMember[i] == 0) continue;
    const size_t before = m_contacts.size();
    for (size_t p = 0; p < m_planes.size(); ++p) {
      if (m_planes[p].heightOf(vectorOf(at[i])) > kWallReach * m_spacing) continue;
      addPlane(store, i, p);
    }
    for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
      const uint32_t j = view.index[q];
      if (!api::holds(motion[j])) continue;
      // Each pair of bodies once, from the body that comes first.
      if (m_bodyOf[j] != kNone && m_bodyOf[j] <= m_bodyOf[i]) continue;
      if (!(distance2(i, j) < reach * reach) || graph.tied(i, j)) continue;
      addContact(store, i, j);
      needSurface(i);
      needSurface(j);
      if (m_bodyOf[j] != kNone) m_bodies[m_bodyOf[j]].hasContacts = true;
    }
    if (m_contacts.size() > before) m_bodies[m_bodyOf[i]].hasContacts = true;
  }
  // One end of a face after the other would rock the body: neighbours in the list are strangers.
  std::sort(m_contacts.begin(), m_contacts.end(), [](const Contact& a, const Contact& b) {
    const auto scattered = [](uint64_t key) { return (key ^ (key >> 29)) * 0xBF58476D1CE4E5B9ull; };
    return std::pair(scattered(a.key), a.key) < std::pair(scattered(b.key), b.key);
  });
  keepImpulses();
}

/// `outward` tells the sides of a sheet apart.
RigidContact::Surface RigidContact::surfaceOf(const ParticleStore& store, uint32_t i, const Vector3& outward) const {
  const std::span<const uint32_t> own(m_own.data() + m_ownBegin[m_ownOf[i]], m_own.data() + m_ownBegin[m_ownOf[i] + 1]);
  const auto fromNeighbour = [&](uint32_t j) { return vectorOf(store.separation(i, j)); };
  // A layer one particle thick: all neighbours lie in one plane.
  Vector3 across;
  for (const uint32_t j : own) {
    const Vector3 normal = fromNeighbour(own[0]).cross(fromNeighbour(j));
    if (normal.squaredNorm() > across.squaredNorm()) across = normal;
  }
  if (const double size = across.norm(); size > 0.5 * m_spacing * m_spacing) {
    across /= across.dot(outward) < 0 ? -size : size;
    const bool sheet = std::all_of(own.begin(), own.end(), [&](uint32_t j) {
      return std::abs(fromNeighbour(j).dot(across)) < kSheet * m_spacing;
    });
    if (sheet) return {across, kFaceNeighbours};
  }
  Vector3 sum;
  for (const uint32_t j : own) sum += fromNeighbour(j);
  const double length = sum.norm();
  // Inside a lattice the neighbours cancel: there is no face.
  if (!(length > 0.5 * m_spacing)) return {};
  return {sum / length, static_cast<uint32_t>(own.size())};
}

/// Normal and distance at rest of a contact of particles.
void RigidContact::orient(const ParticleStore& store, Contact& c) const {
  const Vector3 line = vectorOf(store.separation(c.a.particle, c.b.particle));
  const double length = line.norm();
  c.active = length > 0;
  c.normal.setZero();
  if (!c.active) return;
  const Surface a = surfaceOf(store, c.a.particle, -line), b = surfaceOf(store, c.b.particle, line);
  // A face decides, the flatter one of two. Edges and corners of equal lattices that meet face to face lean evenly to
  // both sides; else they are round.
  Vector3 normal;
  if (a.neighbours == b.neighbours)
    normal = b.normal - a.normal;
  else if (std::max(a.neighbours, b.neighbours) >= kFaceNeighbours)
    normal = b.neighbours > a.neighbours ? b.normal : Vector3(-a.normal);
  const double size = normal.norm();
  if (size > 0.1) normal /= size;
  const double along = line.dot(normal);
  if (!(size > 0.1) || !(along > kFacing * length)) {
    c.normal = line / length;
    c.distance = kRoundDistance * m_spacing;
    return;
  }
  const Vector3 beside = line - along * normal;
  c.active = beside.squaredNorm() < kFaceWidth * kFaceWidth * m_spacing * m_spacing;
  c.normal = normal;
  c.distance = kFaceDistance * m_spacing;
}

}  // namespace ps
