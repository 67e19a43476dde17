// SPDX-License-Identifier: Apache-2.0
// Which particles of rigid bodies may touch what, and how they face each other.
#include "core/base/parallelarrays.h"
#include "core/base/statestream.h"
#include "core/particles/mostaround.h"
#include "core/solver/contact/rigidcontact.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

namespace ps {
namespace {

/// In spacings, of round contact.
constexpr double kRoundDistance = 0.95;
/// How near to a wall the lists look for members: what turns, or is struck, is soon elsewhere.
constexpr double kWallReach = 4;
/// Particles, one after another, that are asked together which walls they may be near.
constexpr size_t kAsked = 32;
/// Numbers of a contact that go on into the next frame.
constexpr size_t kCarried = 11;

/// Whether one of a padded list is of a higher rank; asked 16 at a time without a branch, as mostly none is.
bool anyAbove(const uint32_t* list, size_t count, const std::vector<uint32_t>& rank, uint32_t own) {
  for (size_t k = 0; k < count; k += Neighbours::kListPad) {
    uint32_t above = 0;
    for (size_t lane = 0; lane < Neighbours::kListPad; ++lane) above |= rank[list[k + lane]] > own ? 1u : 0u;
    if (above != 0) return true;
  }
  return false;
}

}  // namespace

void RigidContact::configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                             std::span<const BakedMaterial> materials) {
  m_spacing = settings.spacing;
  m_surface.configure(settings.spacing);
  // Slower than what gravity gives in two substeps nothing bounces, or a body at rest would hop.
  m_dt = settings.dt / settings.substeps;
  m_gravity = vectorOf(settings.gravity);
  m_slowest = 2 * m_gravity.norm() * m_dt;
  findContactFaces(walls, settings.spacing, m_walls);
  m_wallFriction.clear();
  for (const Wall& w : walls) m_wallFriction.push_back(w.friction);
  m_materials.clear();
  for (const BakedMaterial& m : materials) {
    m_materials.push_back({m.scalar(propertyIndex("friction_static")), m.scalar(propertyIndex("friction_kinetic")),
                           m.scalar(propertyIndex("restitution"))});
  }
}

void RigidContact::refreshBodies(const ParticleStore& store, const ConstraintSystem& constraints) {
  assignAll(m_isMember, store.size(), uint8_t{0});
  assignAll(m_bodyOf, store.size(), uint32_t{kNone});
  m_rank.resize(store.size() + 1);
  m_rank.back() = 0;
  forChunks(store.size(), grain::kNumbers, [&](size_t first, size_t last) {
    for (size_t i = first; i < last; ++i) m_rank[i] = api::holds(store.motion()[i]) ? kNone : 0;
  });
  size_t count = 0;
  const auto isHeld = [&](uint32_t i) { return store.velocity()[i].w == 0; };
  constraints.eachRigidGroup([&](std::span<const uint32_t> members) {
    if (std::any_of(members.begin(), members.end(), isHeld)) return;  // it stands, and is met as what is fixed
    for (const uint32_t i : members) {
      m_isMember[i] = 1;
      m_bodyOf[i] = static_cast<uint32_t>(count);
      if (m_rank[i] == kNone) m_rank[i] = m_bodyOf[i] + 1;
    }
    if (count == m_bodies.size()) m_bodies.emplace_back();
    Body body;
    body.members = std::move(m_bodies[count].members);  // their memory is used again
    body.members.assign(members.begin(), members.end());
    m_bodies[count++] = std::move(body);
  });
  m_bodies.resize(count);
}

/// One end of a face after the other would rock the body: neighbours in the list are strangers.
RigidContact::Candidate RigidContact::candidateOf(uint32_t a, uint32_t b, uint32_t plane, uint64_t key) {
  return {(key ^ (key >> 29)) * 0xBF58476D1CE4E5B9ull, key, a, b, plane};
}

RigidContact::Contact RigidContact::contactOf(const ParticleStore& store, const Candidate& candidate) const {
  if (candidate.plane != kNone) return planeContactOf(store, candidate);
  const uint32_t i = candidate.a, j = candidate.b;
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
  c.key = candidate.key;
  c.staticFriction = 0.5 * (a.staticFriction + b.staticFriction);
  c.kineticFriction = 0.5 * (a.kineticFriction + b.kineticFriction);
  c.restitution = std::max(a.bounce, b.bounce);
  return c;
}

RigidContact::Contact RigidContact::planeContactOf(const ParticleStore& store, const Candidate& candidate) const {
  const uint32_t i = candidate.a, plane = candidate.plane;
  Contact c;
  c.a = {i, m_bodyOf[i]};
  c.plane = plane;
  c.key = candidate.key;
  faceWall(store.position()[i], c);
  c.staticFriction = c.kineticFriction = m_wallFriction[plane];
  if (store.material()[i] < m_materials.size()) c.restitution = m_materials[store.material()[i]].bounce;
  return c;
}

/// What a contact carries on, but for its marks.
template <class AContact, class Visit>
void RigidContact::eachNumber(AContact& contact, Visit&& visit) {
  visit(contact.push), visit(contact.approach);
  for (auto* v : {&contact.rub, &contact.drift, &contact.left}) {
    for (auto& c : *v) visit(c);
  }
}

/// Writes `Each` values of each contact, as `put(contact, next)` gives them, some contacts at a time.
template <class T, size_t Each, class Put>
void RigidContact::saveEach(StateWriter& writer, const char* name, const Put& put) const {
  constexpr size_t kAtOnce = 64;
  std::array<T, Each * kAtOnce> some;
  writer.open(name, stateTypeOf<T>(), Each * m_contacts.size());
  for (size_t k = 0; k < m_contacts.size(); k += kAtOnce) {
    T* next = some.data();
    for (size_t c = k; c < std::min(m_contacts.size(), k + kAtOnce); ++c) put(m_contacts[c], next);
    writer.put(some.data(), static_cast<size_t>(next - some.data()) * sizeof(T));
  }
  writer.close();
}

void RigidContact::save(StateWriter& writer) const {
  saveEach<uint64_t, 1>(writer, "rigid/keys", [](const Contact& c, uint64_t*& next) { *next++ = c.key; });
  saveEach<double, kCarried>(writer, "rigid/numbers", [](const Contact& c, double*& next) {
    eachNumber(c, [&](const double& number) { *next++ = number; });
  });
  saveEach<uint8_t, 1>(writer, "rigid/marks", [](const Contact& c, uint8_t*& next) {
    *next++ = static_cast<uint8_t>((c.met ? 1 : 0) | (c.slides ? 2 : 0) | (c.yields ? 4 : 0));
  });
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

/// New lists find most contacts again: what they bore goes on. Both lists are in the same order.
void RigidContact::keepImpulses() {
  const auto place = [](const Contact& c) {
    const Candidate of = candidateOf(kNone, kNone, kNone, c.key);
    return std::pair(of.scattered, of.key);
  };
  forChunks(m_contacts.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    auto former = std::lower_bound(m_former.begin(), m_former.end(), place(m_contacts[first]),
                                   [&](const Contact& c, const auto& here) { return place(c) < here; });
    for (size_t k = first; k < last; ++k) {
      Contact& c = m_contacts[k];
      const auto here = place(c);
      while (former != m_former.end() && place(*former) < here) ++former;
      if (former == m_former.end()) break;
      if (former->key != c.key) continue;
      c.push = former->push, c.rub = former->rub, c.approach = former->approach;
      c.drift = former->drift, c.left = former->left;
      c.met = former->met, c.slides = former->slides, c.yields = former->yields;
    }
  });
}

/// Those that some of a few places may be near.
WallSet RigidContact::wallsNear(std::span<const api::Float4> places) const {
  constexpr double kRounding = 1.0001;
  const PlaceBox box = PlaceBox::around(places);
  WallSet near;
  for (size_t w = 0; w < m_walls.size(); ++w) {
    if (!(box.leastHeight(m_walls[w]) > kRounding * kWallReach * m_spacing)) near.add(w);
  }
  return near;
}

/// By where particles were when the lists were made, not where they are: what is found then depends on nothing else.
void RigidContact::findCandidates(const ParticleStore& store, const Neighbours& neighbours,
                                  const StructureGraph& graph) {
  const api::NeighbourView view = neighbours.view();
  const uint32_t* id = store.id();
  const double skin = kSkinSpacings * m_spacing, reach = std::hypot(kFaceDistance, kFaceWidth) * m_spacing + skin;
  const std::span<const api::Float4> at = neighbours.built();
  const auto distance2 = [&](uint32_t i, uint32_t j) {
    float x = at[i].x - at[j].x, y = at[i].y - at[j].y, z = at[i].z - at[j].z;
    store.period().shorten(x, y, z);
    return Vector3(x, y, z).squaredNorm();
  };
  m_candidatesOf.resize(chunkCount(store.size(), grain::kNeighbours));
  m_bucketsOf.resize(m_candidatesOf.size());
  const auto touches = [this](uint32_t body) {
    const std::atomic_ref<bool> touched(m_bodies[body].hasContacts);
    if (!touched.load(std::memory_order_relaxed)) touched.store(true, std::memory_order_relaxed);
  };
  // Within a body the highest rank around is the body's own.
  const MostAround highest(neighbours.grid(), m_rank, m_highestRank);
  forChunks(store.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    MostAround ranks = highest;
    WallSet walls;
    std::vector<Candidate>& found = m_candidatesOf[first / grain::kNeighbours];
    found.clear();
    for (auto i = static_cast<uint32_t>(first); i < last; ++i) {
      if ((i - first) % kAsked == 0) walls = wallsNear(at.subspan(i, std::min(kAsked, last - i)));
      if (m_isMember[i] == 0) continue;
      walls.forEach(m_walls.size(), [&](size_t wall) {
        if (m_walls[wall].heightOf(vectorOf(at[i])) > kWallReach * m_spacing) return;
        const auto p = static_cast<uint32_t>(wall);
        found.push_back(candidateOf(i, kNone, p, uint64_t{id[i]} << 32 | (kNone - p)));
      });
      // Each pair of bodies once, from the body that comes first.
      const uint32_t own = m_bodyOf[i] + 1;
      if (ranks.at(i) <= own) continue;
      if (!anyAbove(view.index + view.begin[i], view.last[i] - view.begin[i], m_rank, own)) continue;
      for (uint32_t q = view.begin[i]; q < view.last[i]; ++q) {
        const uint32_t j = view.index[q];
        if (m_rank[j] <= own) continue;
        if (!(distance2(i, j) < reach * reach) || graph.tied(i, j)) continue;
        found.push_back(candidateOf(i, j, kNone, uint64_t{id[i]} << 32 | id[j]));
      }
    }
    Buckets& buckets = m_bucketsOf[first / grain::kNeighbours];
    buckets = {};
    for (const Candidate& c : found) {
      ++buckets[c.scattered >> kBucketShift];
      touches(m_bodyOf[c.a]);
      if (c.b != kNone && m_bodyOf[c.b] != kNone) touches(m_bodyOf[c.b]);
    }
  });
  sortCandidates();
}

/// What is scattered falls into buckets of about one size, each of which a thread can sort.
void RigidContact::sortCandidates() {
  Buckets begin;
  uint32_t count = 0;
  for (size_t b = 0; b < kBuckets; ++b) {
    begin[b] = count;
    for (Buckets& own : m_bucketsOf) count += std::exchange(own[b], count);
  }
  m_candidates.resize(count);
  forChunks(m_candidatesOf.size(), 1, [&](size_t chunk, size_t) {
    for (const Candidate& c : m_candidatesOf[chunk])
      m_candidates[m_bucketsOf[chunk][c.scattered >> kBucketShift]++] = c;
  });
  forChunks(kBuckets, 1, [&](size_t bucket, size_t) {
    const size_t end = bucket + 1 < kBuckets ? begin[bucket + 1] : count;
    std::sort(m_candidates.data() + begin[bucket], m_candidates.data() + end,
              [](const Candidate& a, const Candidate& b) {
                return a.scattered != b.scattered ? a.scattered < b.scattered : a.key < b.key;
              });
  });
}

/// Of all that may touch another particle.
void RigidContact::findSurfaces(const ParticleStore& store, const Neighbours& neighbours) {
  const api::Motion* motion = store.motion();
  for (const std::vector<Candidate>& found : m_candidatesOf) {
    for (const Candidate& c : found) {
      if (c.b != kNone) m_surface.add(c.a), m_surface.add(c.b);
    }
  }
  m_surface.find(store, neighbours, [&](uint32_t i, uint32_t j) {
    return m_bodyOf[i] != kNone ? m_bodyOf[j] == m_bodyOf[i]
                                : motion[i] == api::Motion::Static && motion[j] == api::Motion::Static;
  });
}

void RigidContact::refreshContacts(const ParticleStore& store, const Neighbours& neighbours,
                                   ConstraintSystem& constraints) {
  m_former.swap(m_contacts);
  if (m_bodies.empty()) {
    m_contacts.clear();
    m_former.clear();
    return m_surface.clear(0);
  }
  m_surface.clear(store.size());
  for (Body& body : m_bodies) body.hasContacts = false;
  findCandidates(store, neighbours, constraints.graph(store.size()));
  findSurfaces(store, neighbours);
  // With room to spare: their number changes a little with each new list, and a steady frame allocates nothing.
  if (m_candidates.size() > m_contacts.capacity()) m_contacts.reserve(m_candidates.size() + m_candidates.size() / 2);
  m_contacts.resize(m_candidates.size());
  forChunks(m_contacts.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) m_contacts[k] = contactOf(store, m_candidates[k]);
  });
  keepImpulses();
}

/// Normal and distance at rest of a contact of particles.
void RigidContact::faceWall(const api::Float4& place, Contact& c) const {
  const Plane plane = m_walls[c.plane].at(vectorOf(place));
  c.normal = plane.normal;
  c.distance = plane.offset;
}

void RigidContact::orient(const ParticleStore& store, Contact& c) const {
  const uint32_t a = c.a.particle, b = c.b.particle;
  const Vector3 line = vectorOf(store.separation(a, b));
  c.active = line.squaredNorm() > 0;
  c.normal.setZero();
  if (!c.active) return;
  const LatticeSurface::Facing facing =
      m_surface.facing(store, b, m_surface.normalOf(store, a), m_surface.normalOf(store, b), line);
  c.active = !facing.beside;
  c.normal = facing.normal;
  c.distance = facing.face ? kFaceDistance * m_spacing + facing.lift : kRoundDistance * m_spacing;
}

}  // namespace ps
