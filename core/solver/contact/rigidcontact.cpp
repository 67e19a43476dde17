// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/rigidcontact.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Most passes over all contacts in one iteration of the solver: they are cheap beside density, and stacks need many.
constexpr int kSweeps = 20;
/// Fewer are enough when none has moved anything by more than this, in spacings.
constexpr double kStill = 1e-5;
/// Share of the last substep's impulses that the next one starts from: with all of them the split among contacts that
/// bear the same load wanders, and bodies creep.
constexpr double kResumed = 0.8;
/// Share of what creep has left over that each substep asks back. In spacings, the most that it remembers, and what is
/// creep in one substep: more is motion, and to ask that back would push.
constexpr double kRecalled = 0.2, kMostDrift = 1e-3, kCreep = 1e-4;
/// How far a body may sink into a wall, in spacings. In a corner each pass goes half of what is left; a body that two
/// walls are too narrow for ends up in the middle.
constexpr double kDeepest = 0.5;
constexpr int kInwardPasses = 8;
/// Faster than this share of the speed that gravity gives in two substeps a contact slides.
constexpr double kSlides = 0.1;

}  // namespace

/// Centre, and the turn since the start of the substep.
void RigidContact::readCentre(const ParticleStore& store, Body& body) const {
  body.centre = body.shift = body.turn = {};
  body.touched = false;
  for (const uint32_t i : body.members)
    body.centre = body.centre + double{store.mass()[i]} * vectorOf(store.position()[i]);
  body.centre = body.inverseMass * body.centre;
  Vector3 moment;
  for (const uint32_t i : body.members) {
    const Vector3 at = vectorOf(store.position()[i]), way = at - vectorOf(store.previous()[i]);
    moment = moment + double{store.mass()[i]} * cross(at - body.centre, way);
  }
  body.turned = times(body.inverseInertia, moment);
}

void RigidContact::readMasses(const ParticleStore& store, Body& body) const {
  double mass = 0;
  for (const uint32_t i : body.members) mass += double{store.mass()[i]};
  body.inverseMass = 1 / mass;
  readCentre(store, body);
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  for (const uint32_t i : body.members) {
    const double m = store.mass()[i];
    const Vector3 r = vectorOf(store.position()[i]) - body.centre;
    xx += m * (r.y * r.y + r.z * r.z), yy += m * (r.x * r.x + r.z * r.z), zz += m * (r.x * r.x + r.y * r.y);
    xy -= m * r.x * r.y, xz -= m * r.x * r.z, yz -= m * r.y * r.z;
  }
  // A row of particles has no inertia about itself; a little of its own keeps the matrix invertible.
  const double own = 1e-3 * (xx + yy + zz);
  xx += own, yy += own, zz += own;
  const double a = yy * zz - yz * yz, b = xz * yz - xy * zz, c = xy * yz - xz * yy;
  const double scale = 1 / (xx * a + xy * b + xz * c);
  body.inverseInertia[0] = {scale * a, scale * b, scale * c};
  body.inverseInertia[1] = {scale * b, scale * (xx * zz - xz * xz), scale * (xy * xz - xx * yz)};
  body.inverseInertia[2] = {scale * c, scale * (xy * xz - xx * yz), scale * (xx * yy - xy * xy)};
}

/// Velocity and angular velocity into shift and turn.
void RigidContact::readMotion(const ParticleStore& store, Body& body) const {
  readCentre(store, body);
  Vector3 momentum, angular;
  for (const uint32_t i : body.members) {
    const Vector3 p = double{store.mass()[i]} * vectorOf(store.velocity()[i]);
    momentum = momentum + p;
    angular = angular + cross(vectorOf(store.position()[i]) - body.centre, p);
  }
  body.shift = body.inverseMass * momentum;
  body.turn = times(body.inverseInertia, angular);
}

/// How far a side has gone since positions were read; the body's turn is small, so its sine is itself.
Vector3 RigidContact::movedBy(const ParticleStore& store, const Side& side) const {
  if (side.body != kNone) return m_bodies[side.body].shift + cross(m_bodies[side.body].turn, side.arm);
  return side.inverseMass > 0 ? vectorOf(store.position()[side.particle]) - side.start : Vector3{};
}

RigidContact::Response RigidContact::responseOf(const Side& side, Vector3 impulse) const {
  const double square = dot(impulse, impulse);
  if (side.body == kNone) return {side.inverseMass * square, {}};
  const Body& body = m_bodies[side.body];
  const Vector3 lever = cross(side.arm, impulse), turn = times(body.inverseInertia, lever);
  return {body.inverseMass * square + dot(lever, turn), turn};
}

/// `response` is that of the side to the impulse divided by `size`.
void RigidContact::push(ParticleStore& store, const Side& side, Vector3 impulse, double size,
                        const Response& response) {
  if (side.body == kNone) return push(store, side, impulse);
  Body& body = m_bodies[side.body];
  body.shift = body.shift + body.inverseMass * impulse;
  body.turn = body.turn + size * response.turn;
  body.touched = true;
}

void RigidContact::push(ParticleStore& store, const Side& side, Vector3 impulse) {
  if (side.body != kNone) {
    Body& body = m_bodies[side.body];
    body.shift = body.shift + body.inverseMass * impulse;
    body.turn = body.turn + times(body.inverseInertia, cross(side.arm, impulse));
    body.touched = true;
  } else if (side.inverseMass > 0) {
    api::Float4& x = store.position()[side.particle];
    x.x += static_cast<float>(side.inverseMass * impulse.x);
    x.y += static_cast<float>(side.inverseMass * impulse.y);
    x.z += static_cast<float>(side.inverseMass * impulse.z);
  }
}

/// Speed along the surface, in m/s.
double RigidContact::slideOf(const Contact& c, Vector3 speed) {
  const Vector3 along = speed - dot(speed, c.normal) * c.normal;
  return std::sqrt(dot(along, along));
}

/// Adds up what friction left over in the last substep, as long as the two stick.
void RigidContact::remember(Contact& c) const {
  const bool creeps = dot(c.left, c.left) < kCreep * kCreep * m_spacing * m_spacing;
  const bool sticks = c.active && c.met && creeps && !c.slides && !c.yields;
  c.drift = sticks ? c.drift + c.left : Vector3{};
  c.left = {};
  const double length = std::sqrt(dot(c.drift, c.drift)), most = kMostDrift * m_spacing;
  if (length > most) c.drift = most / length * c.drift;
}

void RigidContact::begin(const ParticleStore& store) {
  for (Body& body : m_bodies) {
    if (body.hasContacts) readMasses(store, body);
  }
  for (Contact& c : m_contacts) {
    c.active = true;
    if (c.plane == kNone) orient(store, c);
    Vector3 speed = vectorOf(store.velocity()[c.a.particle]);
    if (c.b.particle != kNone) speed = speed - vectorOf(store.velocity()[c.b.particle]);
    const double before = c.approach;
    c.approach = dot(speed, c.normal);
    // What carried a body in the last substep is the best guess for this one; an impact is over.
    if (!c.met) c.slides = slideOf(c, speed) > m_slowest;
    if (!c.active || before < -m_slowest) c.push = 0, c.rub = {};
    c.push *= kResumed;
    c.rub = kResumed * c.rub;
    remember(c);
    c.met = false;
  }
  m_resume = true;
}

/// A side's place of contact; returns its way since the start of the substep.
Vector3 RigidContact::readSide(const ParticleStore& store, Side& side, Vector3 place) const {
  if (side.particle == kNone) return {};
  side.start = vectorOf(store.position()[side.particle]);
  const Vector3 way = side.start - vectorOf(store.previous()[side.particle]);
  if (side.body == kNone) return way;
  const Body& body = m_bodies[side.body];
  side.arm = place - body.centre;
  return way + cross(body.turned, place - side.start);
}

void RigidContact::readPlaces(const ParticleStore& store) {
  m_open.clear();
  for (Contact& c : m_contacts) {
    if (!c.active) continue;
    const Vector3 a = vectorOf(store.position()[c.a.particle]);
    Vector3 place = a - 0.5 * m_spacing * c.normal, image;
    c.gap = dot(a, c.normal) - c.distance;
    if (c.b.particle != kNone) {
      // Both sides at one place, or a couple would be left over. A free particle can take its push at its centre only.
      const Vector3 line = vectorOf(store.separation(c.a.particle, c.b.particle)), b = a - line;
      place = c.b.inverseMass > 0 ? b : 0.5 * (a + b);
      c.gap = dot(line, c.normal) - c.distance;
      image = b - vectorOf(store.position()[c.b.particle]);
    }
    c.way = readSide(store, c.a, place) - readSide(store, c.b, place - image);
    c.ofA = responseOf(c.a, c.normal);
    c.ofB = responseOf(c.b, c.normal);
    c.mass = 1 / (c.ofA.inverseMass + c.ofB.inverseMass);
    m_open.push_back({&c, c.normal, cross(c.a.arm, c.normal), cross(c.b.arm, c.normal), c.gap, c.a.body, c.b.body});
  }
}

/// m, by how far the two are apart now.
double RigidContact::gapOf(const ParticleStore& store, const Open& open) const {
  const auto along = [&](uint32_t body, Vector3 lever, const Side& side) {
    if (body == kNone) return dot(movedBy(store, side), open.normal);
    return dot(m_bodies[body].shift, open.normal) + dot(m_bodies[body].turn, lever);
  };
  return open.gap + along(open.bodyA, open.leverA, open.contact->a) - along(open.bodyB, open.leverB, open.contact->b);
}

/// Starts from the impulses of the last substep.
void RigidContact::resume(ParticleStore& store) {
  for (Contact& c : m_contacts) {
    if (c.push == 0) continue;
    c.rub = c.rub - dot(c.rub, c.normal) * c.normal;
    const Vector3 impulse = c.push * c.normal + c.rub;
    push(store, c.a, impulse);
    push(store, c.b, -1.0 * impulse);
  }
  m_resume = false;
}

/// Returns the square of how far it moved the two, in m².
double RigidContact::solve(ParticleStore& store, Contact& c, double gap) {
  c.met = true;
  const double before = c.push;
  c.push = std::max(0.0, before - gap * c.mass);
  const double more = c.push - before;
  push(store, c.a, more * c.normal, more, c.ofA);
  push(store, c.b, -more * c.normal, -more, c.ofB);
  // Tangential way since the start of the substep, to be taken back as far as the cone allows.
  const Vector3 moved = c.way + kRecalled * c.drift + movedBy(store, c.a) - movedBy(store, c.b),
                way = moved - dot(moved, c.normal) * c.normal;
  const double square = dot(way, way);
  const Response ofA = responseOf(c.a, way), ofB = responseOf(c.b, way);
  const double back = square > 0 ? square / (ofA.inverseMass + ofB.inverseMass) : 0;
  const Vector3 wanted = c.rub - back * way;
  // One coefficient for the whole substep: contacts that share a load each ask for all of it on their way to the
  // solution, and would take that for slipping.
  const double most = (c.slides ? c.kineticFriction : c.staticFriction) * c.push, size2 = dot(wanted, wanted);
  c.yields = size2 > most * most;
  double rubbed2 = back * back * square;
  if (c.yields) {
    const Vector3 change = most / std::sqrt(size2) * wanted - c.rub;
    push(store, c.a, change);
    push(store, c.b, -1.0 * change);
    c.rub = c.rub + change;
    rubbed2 = dot(change, change);
  } else {
    push(store, c.a, -back * way, -back, ofA);
    push(store, c.b, back * way, back, ofB);
    c.rub = wanted;
  }
  const double perMass = c.ofA.inverseMass + c.ofB.inverseMass;
  return (more * more + rubbed2) * perMass * perMass;
}

void RigidContact::project(ParticleStore& store) {
  if (m_contacts.empty()) return;
  for (Body& body : m_bodies) {
    if (body.hasContacts) readCentre(store, body);
  }
  readPlaces(store);
  if (m_resume) resume(store);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double most = 0;
    for (const Open& open : m_open) {
      const double gap = gapOf(store, open);
      if (gap < 0 || open.contact->push != 0) most = std::max(most, solve(store, *open.contact, gap));
    }
    if (most < kStill * kStill * m_spacing * m_spacing) break;
  }
  for (Contact& c : m_contacts) {
    if (!c.met) continue;
    const Vector3 moved = c.way + movedBy(store, c.a) - movedBy(store, c.b);
    c.left = moved - dot(moved, c.normal) * c.normal;
  }
  for (const Body& body : m_bodies) {
    if (!body.hasContacts || !body.touched) continue;
    // The rotation whose quaternion is (turn/2, 1), normalised: by the angle 2 atan(|turn|/2).
    const double s = 2 / (1 + 0.25 * dot(body.turn, body.turn));
    for (const uint32_t i : body.members) {
      const Vector3 r = vectorOf(store.position()[i]) - body.centre;
      const Vector3 half = 0.5 * cross(body.turn, r);
      const Vector3 x = body.centre + body.shift + r + s * (half + 0.5 * cross(body.turn, half));
      api::Float4& to = store.position()[i];
      to.x = static_cast<float>(x.x), to.y = static_cast<float>(x.y), to.z = static_cast<float>(x.z);
    }
  }
}

Vector3 RigidContact::pushed() const {
  Vector3 sum;
  for (const Contact& c : m_contacts) {
    if (isOutside(c)) sum = sum + c.push * c.normal + c.rub;
  }
  return sum;
}

Vector3 RigidContact::hold(ParticleStore& store, std::span<const api::Float4> held) const {
  Vector3 moved;
  if (held.empty()) return moved;
  for (const Body& body : m_bodies) {
    Vector3 back;
    for (const uint32_t i : body.members) {
      const Vector3 way = vectorOf(held[i]);
      if (dot(way, way) > dot(back, back)) back = way;
    }
    if (dot(back, back) > 0) moved = moved + shift(store, body, back);
  }
  return moved;
}

/// Returns what it moved, kg m.
Vector3 RigidContact::shift(ParticleStore& store, const Body& body, Vector3 way) {
  Vector3 moved;
  for (const uint32_t i : body.members) {
    api::Float4& x = store.position()[i];
    x.x += static_cast<float>(way.x), x.y += static_cast<float>(way.y), x.z += static_cast<float>(way.z);
    moved = moved + double{store.mass()[i]} * way;
  }
  return moved;
}

/// m, how far a body would be behind a wall if its members were at `points`.
double RigidContact::depthOf(const Plane& plane, const Body& body, const api::Float4* points) {
  double depth = 0;
  for (const uint32_t i : body.members) depth = std::max(depth, plane.offset - dot(plane.normal, vectorOf(points[i])));
  return depth;
}

Vector3 RigidContact::keepInside(ParticleStore& store) const {
  const double most = kDeepest * m_spacing;
  Vector3 moved;
  for (const Body& body : m_bodies) {
    if (!body.hasContacts) continue;
    int walls = 0;
    for (int pass = 0; pass < kInwardPasses; ++pass) {
      Vector3 way;
      walls = 0;
      for (const Plane& plane : m_planes) {
        const double depth = depthOf(plane, body, store.position());
        if (!(depth > most)) continue;
        way = way + (depth - most) * plane.normal;
        ++walls;
      }
      if (walls == 0) break;
      moved = moved + shift(store, body, 1.0 / walls * way);
    }
    if (walls > 1) moved = moved + takeBack(store, body);
  }
  return moved;
}

/// A turn that walls leave no room for does not take place: the body stays where it was, unless that was worse.
Vector3 RigidContact::takeBack(ParticleStore& store, const Body& body) const {
  double now = 0, before = 0;
  for (const Plane& plane : m_planes) {
    now = std::max(now, depthOf(plane, body, store.position()));
    before = std::max(before, depthOf(plane, body, store.previous()));
  }
  Vector3 moved;
  if (now <= before || now < kDeepest * m_spacing + kCreep * m_spacing) return moved;
  for (const uint32_t i : body.members) {
    api::Float4& x = store.position()[i];
    const api::Float4& from = store.previous()[i];
    moved = moved + double{store.mass()[i]} * (vectorOf(from) - vectorOf(x));
    x.x = from.x, x.y = from.y, x.z = from.z;
  }
  return moved;
}

void RigidContact::bounce(ParticleStore& store) {
  if (std::none_of(m_contacts.begin(), m_contacts.end(), [](const Contact& c) { return c.met; })) return;
  for (Body& body : m_bodies) {
    if (body.hasContacts) readMotion(store, body);
  }
  readPlaces(store);
  const auto speedOf = [&](const Side& side) {
    if (side.particle == kNone) return Vector3{};
    if (side.body == kNone) return vectorOf(store.velocity()[side.particle]);
    return m_bodies[side.body].shift + cross(m_bodies[side.body].turn, side.arm);
  };
  const auto give = [&](const Side& side, Vector3 impulse) {
    if (side.body != kNone) return push(store, side, impulse);
    if (!(side.inverseMass > 0)) return;
    api::Float4& v = store.velocity()[side.particle];
    v.x += static_cast<float>(side.inverseMass * impulse.x);
    v.y += static_cast<float>(side.inverseMass * impulse.y);
    v.z += static_cast<float>(side.inverseMass * impulse.z);
  };
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const Contact& c : m_contacts) {
      if (!c.met) continue;
      const double wanted = c.approach < -m_slowest ? -c.restitution * c.approach : 0;
      const double change = wanted - dot(speedOf(c.a) - speedOf(c.b), c.normal);
      // What met without bearing anything in the end may part, but not approach.
      if (change < 0 && c.push == 0) continue;
      const Vector3 impulse = change * c.mass * c.normal;
      give(c.a, impulse);
      give(c.b, -1.0 * impulse);
      if (isOutside(c)) m_given.add(impulse);
    }
  }
  for (Contact& c : m_contacts) {
    if (c.met) c.slides = slideOf(c, speedOf(c.a) - speedOf(c.b)) > kSlides * m_slowest;
  }
  for (const Body& body : m_bodies) {
    if (!body.hasContacts || !body.touched) continue;
    for (const uint32_t i : body.members) {
      const Vector3 v = body.shift + cross(body.turn, vectorOf(store.position()[i]) - body.centre);
      api::Float4& to = store.velocity()[i];
      to.x = static_cast<float>(v.x), to.y = static_cast<float>(v.y), to.z = static_cast<float>(v.z);
    }
  }
}

}  // namespace ps
