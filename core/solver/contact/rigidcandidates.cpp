// SPDX-License-Identifier: Apache-2.0
// Which particles of rigid bodies may touch what, and how they face each other.
#include "core/base/statestream.h"
#include "core/solver/contact/rigidcontact.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// In spacings, of round contact.
constexpr double kRoundDistance = 0.95;
/// How near to a wall the lists look for members: what turns, or is struck, is soon elsewhere.
constexpr double kWallReach = 4;
/// Numbers of a contact that go on into the next frame.
constexpr size_t kCarried = 11;

}  // namespace

void RigidContact::configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                             std::span<const BakedMaterial> materials) {
  m_spacing = settings.spacing;
  m_surface.configure(settings.spacing);
  // Slower than what gravity gives in two substeps nothing bounces, or a body at rest would hop.
  m_dt = settings.dt / settings.substeps;
  m_gravity = vectorOf(settings.gravity);
  m_slowest = 2 * m_gravity.norm() * m_dt;
  findContactPlanes(walls, settings.spacing, m_planes);
  m_wallFriction.clear();
  for (const Wall& w : walls) m_wallFriction.push_back(w.friction);
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
  m_surface.clear(0);
  if (m_bodies.empty()) return m_former.clear();
  m_surface.clear(store.size());
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
  const auto same = [&](uint32_t i, uint32_t j) {
    return m_bodyOf[i] != kNone ? m_bodyOf[j] == m_bodyOf[i]
                                : motion[i] == api::Motion::Static && motion[j] == api::Motion::Static;
  };
  const auto needSurface = [&](uint32_t i) {
    if (!m_surface.has(i)) m_surface.find(store, neighbours, m_surface.add(i), same);
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

/// Normal and distance at rest of a contact of particles.
void RigidContact::orient(const ParticleStore& store, Contact& c) const {
  const uint32_t a = c.a.particle, b = c.b.particle;
  const Vector3 line = vectorOf(store.separation(a, b));
  c.active = line.squaredNorm() > 0;
  c.normal.setZero();
  if (!c.active) return;
  const LatticeSurface::Facing facing =
      m_surface.facing(m_surface.normalOf(store, a), m_surface.normalOf(store, b), line);
  c.active = !facing.beside;
  c.normal = facing.normal;
  c.distance = (facing.face ? kFaceDistance : kRoundDistance) * m_spacing;
}

}  // namespace ps
