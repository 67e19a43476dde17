// SPDX-License-Identifier: Apache-2.0
// Impulses between rigid bodies as a contact problem over velocities: of what strikes, before positions move, and of
// what projection has given, after.
#include "core/base/parallel.h"
#include "core/solver/contact/rigidcontact.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace ps {
namespace {

/// Faster than this share of the speed that gravity gives in two substeps a contact slides.
constexpr double kSlides = 0.1;

/// Passes over contacts, and the change of speed that ends them early, as a share of the fastest approach.
constexpr int kPasses = 50;
constexpr double kSettled = 1e-6;
/// Particles farther from each other, in spacings, have nothing to do with each other in this substep.
constexpr double kStrikes = 1.3;

}  // namespace

/// m/s, at the place of contact.
Vector3 RigidContact::velocityOf(const ParticleStore& store, const Side& side) const {
  if (side.particle == kNone) return Vector3::Zero();
  if (side.body == kNone) return vectorOf(store.velocity()[side.particle]);
  return m_bodies[side.body].shift + m_bodies[side.body].turn.cross(side.arm);
}

/// Of a against b.
Vector3 RigidContact::velocityOf(const ParticleStore& store, const Contact& c) const {
  return velocityOf(store, c.a) - velocityOf(store, c.b);
}

/// The same as the substep began, where the body is now: its angular momentum has gone on, not its angular velocity.
Vector3 RigidContact::velocityBefore(const Side& side) const {
  if (side.body == kNone) return side.velocity;
  const Body& body = m_bodies[side.body];
  return body.before.velocity + (body.inverseInertia * body.before.angular).cross(side.arm);
}

int RigidContact::slotOf(const ParticleStore& store, const Contact& c) const {
  return c.plane != kNone ? m_reactions->ofWall(c.plane) : m_reactions->ofBody(store.body()[c.b.particle]);
}

/// Impulse in kg m/s that a wall or a fixed particle gave to a.
void RigidContact::bookOutside(const ParticleStore& store, const Contact& c, const Vector3& impulse) {
  m_externalImpulse.add(impulse);
  m_reactions->add(slotOf(store, c), m_bodies[c.a.body].centre + c.a.arm, -impulse);
}

/// Impulse in kg m/s.
void RigidContact::give(ParticleStore& store, const Side& side, const Vector3& impulse) {
  if (side.body != kNone) {
    Body& body = m_bodies[side.body];
    body.shift += body.inverseMass * impulse;
    body.turn += body.inverseInertia * side.arm.cross(impulse);
    body.touched = true;
  } else if (side.inverseMass > 0) {
    addTo(store.velocity()[side.particle], side.inverseMass * impulse);
  }
}

void RigidContact::give(ParticleStore& store, const Contact& c, const Vector3& impulse) {
  give(store, c.a, impulse);
  give(store, c.b, -impulse);
}

/// Bodies that may touch each other are one island.
void RigidContact::findIslands() {
  const auto islandOf = [&](uint32_t body) {
    while (m_bodies[body].island != body) body = m_bodies[body].island = m_bodies[m_bodies[body].island].island;
    return body;
  };
  for (uint32_t b = 0; b < m_bodies.size(); ++b) m_bodies[b].island = b;
  for (const Contact& c : m_contacts) {
    if (c.b.body == kNone) continue;
    const uint32_t a = islandOf(c.a.body), b = islandOf(c.b.body);
    m_bodies[std::max(a, b)].island = std::min(a, b);
  }
  for (uint32_t b = 0; b < m_bodies.size(); ++b) m_bodies[b].island = islandOf(b);
}

/// A contact is large, and those that take part are asked many times.
void RigidContact::gatherTaking() {
  findIndices(m_contacts.size(), m_some, [&](size_t k) { return m_contacts[k].takesPart; });
  m_taking.clear();
  for (const uint32_t k : m_some) m_taking.push_back(&m_contacts[k]);
}

/// The normal impulse stays positive; what strikes rubs within the cone. Returns by how much the normal speed was
/// changed, m/s.
double RigidContact::solveSpeed(ParticleStore& store, Contact& c) {
  const double before = c.impulse;
  c.impulse = std::max(0.0, before + (c.wanted - velocityOf(store, c).dot(c.normal)) * c.mass);
  if (c.impulse != before) give(store, c, (c.impulse - before) * c.normal);
  if (c.strikes && c.kineticFriction > 0) {
    const Vector3 speed = velocityOf(store, c), slip = speed - speed.dot(c.normal) * c.normal;
    const double perMass = responseOf(c.a, slip).inverseMass + responseOf(c.b, slip).inverseMass;
    const double back = perMass > 0 ? slip.squaredNorm() / perMass : 0;
    Vector3 friction = c.friction - back * slip;
    const double size = friction.norm(), most = c.kineticFriction * c.impulse;
    if (size > most) friction *= most / size;
    give(store, c, friction - c.friction);
    c.friction = friction;
  }
  return std::abs(c.impulse - before) / c.mass;
}

/// Projected Gauss-Seidel over the contacts that take part.
void RigidContact::solveSpeeds(ParticleStore& store) {
  double fastest = 0;
  for (const Contact* c : m_taking) fastest = std::max(fastest, std::abs(c->approach));
  for (int pass = 0; pass < kPasses; ++pass) {
    double most = 0;
    for (Contact* c : m_taking) most = std::max(most, solveSpeed(store, *c));
    if (!(most > kSettled * fastest)) break;
  }
  takeGainedEnergy(store);
}

/// The work of the impulses against the mean of the speeds before and after is what contact adds to the energy of an
/// island: what it must not add is left out of all its impulses.
void RigidContact::takeGainedEnergy(ParticleStore& store) {
  for (Body& body : m_bodies) body.workBefore = body.workChange = 0;
  for (const Contact* contact : m_taking) {
    const Contact& c = *contact;
    const Vector3 impulse = c.impulse * c.normal + c.friction;
    Body& island = m_bodies[m_bodies[c.a.body].island];
    island.workBefore += impulse.dot(c.before);
    island.workChange += impulse.dot(velocityOf(store, c) - c.before);
  }
  for (Contact* contact : m_taking) {
    Contact& c = *contact;
    const Body& island = m_bodies[m_bodies[c.a.body].island];
    if (!(island.workBefore + 0.5 * island.workChange > 0)) continue;
    const double share = std::clamp(-2 * island.workBefore / island.workChange, 0.0, 1.0);
    give(store, c, (share - 1) * (c.impulse * c.normal + c.friction));
    c.impulse *= share;
    c.friction *= share;
  }
}

/// A contact of bodies, walls or what is fixed that would overlap by the end of the substep, and is fast. Positions
/// are those predicted along straight lines.
bool RigidContact::isStruck(const ParticleStore& store, Contact& c) const {
  if (c.b.inverseMass > 0) return false;
  Vector3 speed = vectorOf(store.velocity()[c.a.particle]);
  if (c.plane == kNone) {
    const Vector3 line = vectorOf(store.separation(c.a.particle, c.b.particle));
    speed -= vectorOf(store.velocity()[c.b.particle]);
    if (!(speed.norm() > m_slowest) || line.squaredNorm() > kStrikes * kStrikes * m_spacing * m_spacing) return false;
    orient(store, c);
    if (!c.active) return false;
    if (!(line.dot(c.normal) < c.distance)) return false;
  } else {
    if (m_walls[c.plane].isCurved()) faceWall(store.position()[c.a.particle], c);
    if (!(gapAt(c, store.position()) < 0)) return false;
  }
  return speed.dot(c.normal) < -m_slowest;
}

/// Where a contact was when the substep began, and how it went on from there.
RigidContact::Meeting RigidContact::meetingOf(const ParticleStore& store, const Contact& c) const {
  Meeting m;
  m.place = vectorOf(store.previous()[c.a.particle]);
  m.way = m_dt * vectorOf(store.velocity()[c.a.particle]);
  m.line = m_spacing * c.normal;
  m.gap = m.place.dot(c.normal) - c.distance;
  m.wayOfA = m.way;
  if (c.plane != kNone) return m;
  const Vector3 apart = m.place - vectorOf(store.previous()[c.b.particle]);
  float x = static_cast<float>(apart.x()), y = static_cast<float>(apart.y()), z = static_cast<float>(apart.z());
  store.period().shorten(x, y, z);
  m.line = Vector3(x, y, z);
  m.image = apart - m.line;
  m.way -= m_dt * vectorOf(store.velocity()[c.b.particle]);
  m.gap = m.line.dot(c.normal) - c.distance;
  return m;
}

/// Share of the substep after which two that strike each other meet.
double RigidContact::timeOf(const Meeting& m, const Contact& c) {
  const double closing = -m.way.dot(c.normal);
  return closing > 0 ? std::clamp(m.gap / closing, 0.0, 1.0) : 0;
}

/// Gap as the substep began, speed, and arms at the time when the first of the island strike each other: one instant
/// for all of them, or their angular momentum would not add up.
void RigidContact::readStart(const ParticleStore& store, Contact& c) {
  const Meeting m = meetingOf(store, c);
  const Body& body = m_bodies[c.a.body];
  const double share = m_bodies[body.island].time, time = share * m_dt;
  c.gap = m.gap;
  const Vector3 line = c.plane == kNone ? Vector3(m.line + share * m.way) : m.line;
  const Vector3 place = m.place + share * m.wayOfA - 0.5 * line;
  c.a.arm = place - body.centre - time * body.shift;
  if (c.b.body != kNone) c.b.arm = place - m.image - m_bodies[c.b.body].centre - time * m_bodies[c.b.body].shift;
  readResponse(c);
  c.before = velocityOf(store, c);
  c.approach = c.before.dot(c.normal);
  c.strikes = c.strikes && c.approach < -m_slowest;
  c.impulse = 0;
  c.friction.setZero();
  if (c.strikes && c.restitution > 0) {
    // What falls onto something fixed has not yet the speed that gravity gives after they meet.
    const double later = c.b.body == kNone ? (m_dt - time) * m_gravity.dot(c.normal) : 0;
    c.wanted = later - c.restitution * (c.approach - later);
  } else {
    // Others of these bodies may come as near as they would have, or until they touch.
    c.wanted = std::min(c.strikes ? 0 : c.approach, -std::max(0.0, c.gap) / m_dt);
  }
}

void RigidContact::strike(ParticleStore& store) {
  std::atomic<bool> any = false;
  forChunks(m_contacts.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    bool some = false;
    for (size_t k = first; k < last; ++k) {
      m_contacts[k].strikes = isStruck(store, m_contacts[k]);
      some = some || m_contacts[k].strikes;
    }
    if (some) any.store(true, std::memory_order_relaxed);
  });
  if (!any) return;
  findIslands();
  for (Body& body : m_bodies) body.struck = false, body.time = 1;
  for (const Contact& c : m_contacts) {
    if (!c.strikes) continue;
    Body& island = m_bodies[m_bodies[c.a.body].island];
    island.struck = true;
    island.time = std::min(island.time, timeOf(meetingOf(store, c), c));
  }
  for (Body& body : m_bodies) {
    body.touched = false;
    if (!m_bodies[body.island].struck) continue;
    readMasses(store, body, store.previous());
    const BodyMotion motion = motionOf(store, body, body.centre, store.previous());
    body.shift = motion.velocity;
    body.turn = body.inverseInertia * motion.angular;
    body.late.setZero();
  }
  forChunks(m_contacts.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      Contact& c = m_contacts[k];
      c.takesPart = m_bodies[m_bodies[c.a.body].island].struck && !(c.b.inverseMass > 0);
      if (!c.takesPart) continue;
      if (c.plane == kNone && !c.strikes) orient(store, c);
      c.takesPart = c.plane == kNone ? c.active : gapAt(c, store.position()) < kOpen * m_spacing;
      if (c.takesPart) readStart(store, c);
    }
  });
  gatherTaking();
  solveSpeeds(store);
  for (const Contact* contact : m_taking) {
    const Contact& c = *contact;
    const Vector3 impulse = c.impulse * c.normal + c.friction;
    if (isOutside(c)) bookOutside(store, c, impulse);
    // Until they met they went on as before.
    const double time = m_bodies[m_bodies[c.a.body].island].time * m_dt;
    m_bodies[c.a.body].late -= time * impulse;
    if (c.b.body != kNone) m_bodies[c.b.body].late += time * impulse;
  }
  for (const Body& body : m_bodies) {
    if (!body.touched) continue;
    for (const uint32_t i : body.members) {
      const Vector3 from = vectorOf(store.previous()[i]), start = from + body.inverseMass * body.late;
      const Vector3 velocity = body.shift + body.turn.cross(from - body.centre);
      assignTo(store.previous()[i], start);
      assignTo(store.velocity()[i], velocity);
      assignTo(store.position()[i], start + m_dt * velocity);
    }
  }
}

/// Takes the impulses of projection out, reads the speeds without them, and gives the impulses again, all of them
/// where the bodies are now.
void RigidContact::readApproaches(ParticleStore& store) {
  for (Body& body : m_bodies) {
    if (!body.hasContacts || body.pushed.isZero(0)) continue;
    body.touched = true;
    body.shift -= body.inverseMass / m_dt * body.pushed;
    body.turn -= 1 / m_dt * (body.inverseInertia * body.twisted);
  }
  for (const Contact* c : m_taking) {
    if (c->b.body == kNone) give(store, c->b, 1 / m_dt * (c->push * c->normal + c->rub));
  }
  for (Contact* contact : m_taking) {
    Contact& c = *contact;
    c.before = velocityOf(store, c);
    // What presses all the time, a rope or a liquid, does not strike.
    const double pressed = c.before.dot(c.normal);
    const double struck = (velocityBefore(c.a) - velocityBefore(c.b)).dot(c.normal);
    c.approach = pressed < 0 ? std::clamp(struck, pressed, 0.0) : pressed;
    // One that was parting may come back as fast at most, or another's impact would give it energy.
    c.wanted = c.approach < -m_slowest ? -c.restitution * c.approach : -std::max(0.0, c.approach - m_slowest);
    c.impulse = c.push / m_dt;
    c.friction = 1 / m_dt * c.rub;
  }
  for (const Contact* c : m_taking) give(store, *c, c->impulse * c->normal + c->friction);
}

void RigidContact::bounce(ParticleStore& store) {
  forChunks(m_contacts.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) m_contacts[k].takesPart = m_contacts[k].met, m_contacts[k].strikes = false;
  });
  gatherTaking();
  if (m_taking.empty()) return;
  for (Body& body : m_bodies) {
    if (!body.hasContacts) continue;
    // The inertia has turned with the body.
    body.centre = centreOf(store, body, store.position());
    const BodyMotion motion = motionOf(store, body, body.centre, store.position());
    body.shift = motion.velocity;
    body.turn = body.inverseInertia * motion.angular;
    body.touched = false;
  }
  readPlaces(store);
  for (Contact* c : m_taking) readResponse(*c);
  findIslands();
  readApproaches(store);
  solveSpeeds(store);
  for (Contact* contact : m_taking) {
    Contact& c = *contact;
    c.slides = slideOf(c, velocityOf(store, c)) > kSlides * m_slowest;
    if (!isOutside(c)) continue;
    const Vector3 booked = 1 / m_dt * (c.push * c.normal + c.rub);
    bookOutside(store, c, c.impulse * c.normal + c.friction - booked);
  }
  for (const Body& body : m_bodies) {
    if (!body.hasContacts || !body.touched) continue;
    for (const uint32_t i : body.members) {
      const Vector3 arm = vectorOf(store.position()[i]) - body.centre;
      assignTo(store.velocity()[i], body.shift + body.turn.cross(arm));
    }
  }
}

}  // namespace ps
