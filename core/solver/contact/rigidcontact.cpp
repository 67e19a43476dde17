// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/rigidcontact.h"

#include "core/base/parallel.h"
#include "core/solver/contact/inertia.h"
#include "core/solver/contact/membersums.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Most passes over all contacts in one iteration of the solver: they are cheap beside density, and stacks need many.
constexpr int kSweeps = 20;
/// Fewer are enough when a pass has moved no body and no particle by more than this, in spacings.
constexpr double kStill = 1e-5;
/// Share of the last substep's impulses that the next one starts from: with all of them the split among contacts that
/// bear the same load wanders, and bodies creep.
constexpr double kResumed = 0.8;
/// Share of what creep has left over that each substep asks back, and the most that it remembers, in spacings.
constexpr double kRecalled = 0.2, kMostDrift = 1e-3;
/// Compliance of a contact, as a share of its generalised inverse mass: a body's own weight presses in by about a
/// micrometre, what is ten thousand times heavier than the body below it by a centimetre. Without it a body that is
/// wider than the room between two walls is pressed harder by each pass, and friction, which is a share of that force,
/// no longer converges: frozen ponds climbed out of their trays at 4 mm/s.
constexpr double kCompliance = 0.005;

}  // namespace

Vector3 RigidContact::centreOf(const ParticleStore& store, const Body& body, const api::Float4* points) {
  struct Sum {
    Vector3 place;
    void operator+=(const Sum& other) { place += other.place; }
  };
  const Sum sum =
      sumOver<Sum>(body.members, [&](Sum& s, uint32_t i) { s.place += double{store.mass()[i]} * vectorOf(points[i]); });
  return body.inverseMass * sum.place;
}

/// Centre, and the turn since the start of the substep.
void RigidContact::readCentre(const ParticleStore& store, Body& body) {
  struct Sum {
    Vector3 place, way, moment;
    void operator+=(const Sum& other) { place += other.place, way += other.way, moment += other.moment; }
  };
  // Seen from a member, so that nothing large cancels; the moment about the centre follows.
  const Vector3 origin = vectorOf(store.position()[body.members[0]]);
  const Sum sum = sumOver<Sum>(body.members, [&](Sum& s, uint32_t i) {
    const Vector3 at = vectorOf(store.position()[i]), arm = at - origin;
    const Vector3 way = double{store.mass()[i]} * (at - vectorOf(store.previous()[i]));
    s.place += double{store.mass()[i]} * arm, s.way += way, s.moment += arm.cross(way);
  });
  const Vector3 centre = body.inverseMass * sum.place;
  body.centre = origin + centre;
  body.shift = body.turn = Vector3::Zero();
  body.touched = false;
  body.turned = body.inverseInertia * (sum.moment - centre.cross(sum.way));
}

/// Mass, centre and inertia of members at `points`.
void RigidContact::readMasses(const ParticleStore& store, Body& body, const api::Float4* points) {
  const MassSpread spread = massSpread(store, body.members, points);
  body.inverseMass = 1 / spread.mass;
  body.centre = spread.centre;
  body.inverseInertia = spread.inverseInertia;
}

/// Velocity and angular momentum of members at `points`, about their centre.
RigidContact::BodyMotion RigidContact::motionOf(const ParticleStore& store, const Body& body, const Vector3& centre,
                                                const api::Float4* points) {
  struct Sum {
    Vector3 linear, angular;
    void operator+=(const Sum& other) { linear += other.linear, angular += other.angular; }
  };
  const Sum sum = sumOver<Sum>(body.members, [&](Sum& s, uint32_t i) {
    const Vector3 p = double{store.mass()[i]} * vectorOf(store.velocity()[i]);
    s.linear += p;
    s.angular += (vectorOf(points[i]) - centre).cross(p);
  });
  return {body.inverseMass * sum.linear, sum.angular};
}

/// How far a side has gone since positions were read; the body's turn is small, so its sine is itself.
Vector3 RigidContact::movedBy(const ParticleStore& store, const Side& side) const {
  if (side.body != kNone) return m_bodies[side.body].shift + m_bodies[side.body].turn.cross(side.arm);
  if (!(side.inverseMass > 0)) return Vector3::Zero();
  return vectorOf(store.position()[side.particle]) - side.start;
}

RigidContact::Response RigidContact::responseOf(const Side& side, const Vector3& impulse) const {
  const double square = impulse.squaredNorm();
  if (side.body == kNone) return {side.inverseMass * square, {}};
  const Body& body = m_bodies[side.body];
  const Vector3 lever = side.arm.cross(impulse), turn = body.inverseInertia * lever;
  return {body.inverseMass * square + lever.dot(turn), turn};
}

/// `response` is that of the side to the impulse divided by `size`.
void RigidContact::push(ParticleStore& store, const Side& side, const Vector3& impulse, double size,
                        const Response& response) {
  if (side.body == kNone) return push(store, side, impulse);
  Body& body = m_bodies[side.body];
  body.shift += body.inverseMass * impulse;
  body.turn += size * response.turn;
  body.pushed += impulse;
  body.twisted += side.arm.cross(impulse);
  body.touched = true;
}

void RigidContact::push(ParticleStore& store, const Side& side, const Vector3& impulse) {
  if (side.body != kNone) {
    Body& body = m_bodies[side.body];
    body.shift += body.inverseMass * impulse;
    body.turn += body.inverseInertia * side.arm.cross(impulse);
    body.pushed += impulse;
    body.twisted += side.arm.cross(impulse);
    body.touched = true;
  } else if (side.inverseMass > 0) {
    addTo(store.position()[side.particle], side.inverseMass * impulse);
  }
}

/// Speed along the surface, in m/s.
double RigidContact::slideOf(const Contact& c, const Vector3& speed) {
  const Vector3 along = speed - speed.dot(c.normal) * c.normal;
  return along.norm();
}

/// Adds up what friction left over in the last substep, as long as the two stick.
void RigidContact::remember(Contact& c) const {
  const bool creeps = c.left.squaredNorm() < kCreep * kCreep * m_spacing * m_spacing;
  const bool sticks = c.active && c.met && creeps && !c.slides && !c.yields;
  if (sticks)
    c.drift += c.left;
  else
    c.drift.setZero();
  c.left.setZero();
  const double length = c.drift.norm(), most = kMostDrift * m_spacing;
  if (length > most) c.drift *= most / length;
}

void RigidContact::begin(const ParticleStore& store) {
  for (Body& body : m_bodies) {
    if (!body.hasContacts) continue;
    readMasses(store, body, store.position());
    // Velocities still belong to the places where the substep began.
    body.before = motionOf(store, body, centreOf(store, body, store.previous()), store.previous());
    body.pushed = body.twisted = Vector3::Zero();
  }
  forChunks(m_contacts.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) beginContact(store, m_contacts[k]);
  });
  findIndices(m_contacts.size(), m_some, [&](size_t k) { return m_contacts[k].active; });
  m_open.resize(m_some.size());
  forChunks(m_open.size(), grain::kNeighbours, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      Contact& c = m_contacts[m_some[k]];
      m_open[k] = {&c, {}, {}, {}, 0, c.a.body, c.b.body};
    }
  });
  m_resume = true;
}

void RigidContact::beginContact(const ParticleStore& store, Contact& c) const {
  if (c.plane != kNone && m_walls[c.plane].isCurved()) faceWall(store.position()[c.a.particle], c);
  // What is far from a wall does not come to it while positions are corrected.
  c.active = c.plane == kNone || gapAt(c, store.position()) < kOpen * m_spacing;
  if (!c.active) {
    c.push = c.approach = 0, c.met = false;
    c.rub = c.drift = c.left = {};
    return;
  }
  if (c.b.particle != kNone && c.b.body == kNone) c.b.velocity = vectorOf(store.velocity()[c.b.particle]);
  if (c.plane == kNone) orient(store, c);
  Vector3 speed = vectorOf(store.velocity()[c.a.particle]);
  if (c.b.particle != kNone) speed -= vectorOf(store.velocity()[c.b.particle]);
  const double before = c.approach;
  c.approach = speed.dot(c.normal);
  // What carried a body in the last substep is the best guess for this one; an impact is over.
  if (!c.met) c.slides = slideOf(c, speed) > m_slowest;
  if (!c.active || c.strikes || before < -m_slowest) c.push = 0, c.rub = {};
  c.push *= kResumed;
  c.rub = kResumed * c.rub;
  remember(c);
  c.met = false;
}

/// A side's place of contact; returns its way since the start of the substep.
Vector3 RigidContact::readSide(const ParticleStore& store, Side& side, const Vector3& place) const {
  if (side.particle == kNone) return Vector3::Zero();
  side.start = vectorOf(store.position()[side.particle]);
  const Vector3 way = side.start - vectorOf(store.previous()[side.particle]);
  if (side.body == kNone) return way;
  const Body& body = m_bodies[side.body];
  side.arm = place - body.centre;
  return way + body.turned.cross(place - side.start);
}

/// Many at a time: who solves them next, one after another, would have to get what others have written.
void RigidContact::readPlaces(const ParticleStore& store) {
  forChunks(m_open.size(), grain::kConstraints, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) readPlace(store, m_open[k]);
  });
}

void RigidContact::readPlace(const ParticleStore& store, Open& open) const {
  Contact& c = *open.contact;
  const Vector3 a = vectorOf(store.position()[c.a.particle]);
  Vector3 place = a - 0.5 * m_spacing * c.normal, image;
  c.gap = a.dot(c.normal) - c.distance;
  if (c.b.particle != kNone) {
    // Both sides at one place, or a couple would be left over. A free particle can take its push at its centre only.
    const Vector3 line = vectorOf(store.separation(c.a.particle, c.b.particle)), b = a - line;
    place = c.b.inverseMass > 0 ? b : 0.5 * (a + b);
    c.gap = line.dot(c.normal) - c.distance;
    image = b - vectorOf(store.position()[c.b.particle]);
  }
  c.way = readSide(store, c.a, place) - readSide(store, c.b, place - image);
  c.mass = 0;
  open.normal = c.normal;
  open.leverA = c.a.arm.cross(c.normal), open.leverB = c.b.arm.cross(c.normal);
  open.gap = c.gap;
}

/// Of those that touch: most of what is open does not.
void RigidContact::readResponse(Contact& c) const {
  c.ofA = responseOf(c.a, c.normal);
  c.ofB = responseOf(c.b, c.normal);
  c.mass = 1 / (c.ofA.inverseMass + c.ofB.inverseMass);
}

/// m, by how far the two are apart now.
double RigidContact::gapOf(const ParticleStore& store, const Open& open) const {
  const auto along = [&](uint32_t body, const Vector3& lever, const Side& side) {
    if (body == kNone) return movedBy(store, side).dot(open.normal);
    return m_bodies[body].shift.dot(open.normal) + m_bodies[body].turn.dot(lever);
  };
  return open.gap + along(open.bodyA, open.leverA, open.contact->a) - along(open.bodyB, open.leverB, open.contact->b);
}

/// Starts from the impulses of the last substep.
void RigidContact::resume(ParticleStore& store) {
  for (const Open& open : m_open) {  // others have no push
    Contact& c = *open.contact;
    if (c.push == 0) continue;
    c.rub -= c.rub.dot(c.normal) * c.normal;
    const Vector3 impulse = c.push * c.normal + c.rub;
    push(store, c.a, impulse);
    push(store, c.b, -impulse);
  }
  m_resume = false;
}

/// Returns the square of how far it moved the two, in m².
double RigidContact::solve(ParticleStore& store, Contact& c, double gap) {
  c.met = true;
  if (c.mass == 0) readResponse(c);
  const double before = c.push;
  c.push = std::max(0.0, before - (gap * c.mass + kCompliance * before) / (1 + kCompliance));
  const double more = c.push - before;
  push(store, c.a, more * c.normal, more, c.ofA);
  push(store, c.b, -more * c.normal, -more, c.ofB);
  // Tangential way since the start of the substep, to be taken back as far as the cone allows.
  const Vector3 moved = c.way + kRecalled * c.drift + movedBy(store, c.a) - movedBy(store, c.b),
                way = moved - moved.dot(c.normal) * c.normal;
  const double square = way.squaredNorm();
  const Response ofA = responseOf(c.a, way), ofB = responseOf(c.b, way);
  const double back = square > 0 ? square / (ofA.inverseMass + ofB.inverseMass) : 0;
  const Vector3 wanted = c.rub - back * way;
  // One coefficient for the whole substep: contacts that share a load each ask for all of it on their way to the
  // solution, and would take that for slipping.
  const double most = (c.slides ? c.kineticFriction : c.staticFriction) * c.push, size2 = wanted.squaredNorm();
  c.yields = size2 > most * most;
  double rubbed2 = back * back * square;
  if (c.yields) {
    const Vector3 change = most / std::sqrt(size2) * wanted - c.rub;
    push(store, c.a, change);
    push(store, c.b, -change);
    c.rub += change;
    rubbed2 = change.squaredNorm();
  } else {
    push(store, c.a, -back * way, -back, ofA);
    push(store, c.b, back * way, back, ofB);
    c.rub = wanted;
  }
  const double perMass = c.ofA.inverseMass + c.ofB.inverseMass;
  return (more * more + rubbed2) * perMass * perMass;
}

/// Notes where bodies are, and how far from their centres they are touched.
void RigidContact::markPlaces() {
  for (Body& body : m_bodies) body.markedShift = body.shift, body.markedTurn = body.turn, body.reach2 = 0;
  for (const Open& open : m_open) {
    for (const Side* side : {&open.contact->a, &open.contact->b}) {
      if (side->body == kNone) continue;
      double& reach2 = m_bodies[side->body].reach2;
      reach2 = std::max(reach2, side->arm.squaredNorm());
    }
  }
}

/// The square of how far bodies have moved since they were marked, at most, in m², where they are touched; marks them
/// anew. What counts is a body as a whole: the hundreds of contacts of a face push it by turns and leave it in its
/// place, long after that is found.
double RigidContact::moveSinceMark() {
  double most = 0;
  for (Body& body : m_bodies) {
    if (!body.touched) continue;
    const double shift2 = (body.shift - body.markedShift).squaredNorm();
    const double turn2 = body.reach2 * (body.turn - body.markedTurn).squaredNorm();
    most = std::max(most, 2 * (shift2 + turn2));
    body.markedShift = body.shift, body.markedTurn = body.turn;
  }
  return most;
}

void RigidContact::project(ParticleStore& store) {
  if (m_contacts.empty()) return;
  for (Body& body : m_bodies) {
    if (body.hasContacts) readCentre(store, body);
  }
  readPlaces(store);
  if (m_resume) resume(store);
  markPlaces();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double most = 0;
    for (const Open& open : m_open) {
      const double gap = gapOf(store, open);
      if (!(gap < 0) && open.contact->push == 0) continue;
      const double moved = solve(store, *open.contact, gap);
      if (open.contact->b.inverseMass > 0) most = std::max(most, moved);
    }
    if (std::max(most, moveSinceMark()) < kStill * kStill * m_spacing * m_spacing) break;
  }
  forChunks(m_open.size(), grain::kConstraints, [&](size_t first, size_t last) {
    for (size_t k = first; k < last; ++k) {
      Contact& c = *m_open[k].contact;
      if (!c.met) continue;
      const Vector3 moved = c.way + movedBy(store, c.a) - movedBy(store, c.b);
      c.left = moved - moved.dot(c.normal) * c.normal;
    }
  });
  for (Body& body : m_bodies) {
    if (body.hasContacts && body.touched) place(store, body);
  }
}

/// Moves a body by its shift and its turn.
void RigidContact::place(ParticleStore& store, Body& body) {
  const Vector3 half = 0.5 * body.turn;
  const Matrix3 rotation = Quaternion(1, half.x(), half.y(), half.z()).normalized().toRotationMatrix();
  forMembers(body.members, [&](uint32_t i) {
    const Vector3 arm = vectorOf(store.position()[i]) - body.centre;
    assignTo(store.position()[i], body.centre + body.shift + rotation * arm);
  });
  body.inverseInertia = rotation * body.inverseInertia * rotation.transpose();
}

Vector3 RigidContact::pushed() const {
  Vector3 sum;
  for (const Open& open : m_open) {
    const Contact& c = *open.contact;
    if (isOutside(c)) sum += c.push * c.normal + c.rub;
  }
  return sum;
}

void RigidContact::tellPushed(const ParticleStore& store) const {
  if (!m_reactions->any()) return;
  for (const Open& open : m_open) {
    const Contact& c = *open.contact;
    if (!isOutside(c) || c.push == 0) continue;
    const Vector3 place = m_bodies[c.a.body].centre + c.a.arm;
    m_reactions->add(slotOf(store, c), place, -m_reactions->perStep() * (c.push * c.normal + c.rub));
  }
}

Vector3 RigidContact::hold(ParticleStore& store, std::span<const api::Float4> held,
                           std::span<const uint32_t> heldBy) const {
  Vector3 moved;
  if (held.empty()) return moved;
  for (const Body& body : m_bodies) {
    Vector3 back, place;
    uint32_t by = 0;
    for (const uint32_t i : body.members) {
      const Vector3 way = vectorOf(held[i]);
      if (way.squaredNorm() > back.squaredNorm()) back = way, place = vectorOf(store.position()[i]), by = heldBy[i];
    }
    if (!(back.squaredNorm() > 0)) continue;
    const Vector3 given = shift(store, body, back);
    moved += given;
    m_reactions->add(m_reactions->ofBody(by), place, -m_reactions->perStep() * given);
  }
  return moved;
}

/// Returns what it moved, kg m.
Vector3 RigidContact::shift(ParticleStore& store, const Body& body, const Vector3& way) {
  Vector3 moved;
  for (const uint32_t i : body.members) {
    addTo(store.position()[i], way);
    moved += double{store.mass()[i]} * way;
  }
  return moved;
}

}  // namespace ps
