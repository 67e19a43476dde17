// SPDX-License-Identifier: Apache-2.0
// The impulses by which soft pieces part, over the speeds of rigid bodies.
#include "core/solver/contact/rebound.h"

#include "core/solver/contact/membersums.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Passes over all that touches, and the change of speed that ends them, as a share of the fastest approach.
constexpr int kPasses = 50;
constexpr double kSettled = 1e-6;

}  // namespace

/// Both sides at one place, or a couple would be left over.
void Rebound::place(const ParticleStore& store, Touch& t) const {
  const Vector3 a = vectorOf(store.position()[t.a]);
  Vector3 line = m_spacing * t.normal, image = Vector3::Zero();
  if (t.b != kNone) {
    line = vectorOf(store.separation(t.a, t.b));
    image = a - line - vectorOf(store.position()[t.b]);
  }
  const Vector3 spot = a - 0.5 * line;
  t.armA = spot - m_pieces[m_pieceOf[t.a]].spread.centre;
  const uint32_t b = wholePieceOf(t.b);
  if (b != kNone) t.armB = spot - image - m_pieces[b].spread.centre;
  t.outside = t.b != kNone && b == kNone ? vectorOf(store.velocity()[t.b]) : Vector3::Zero();
  t.mass = 1 / responseOf(t, t.normal);
}

/// m/s, of a against b as these motions have it.
Vector3 Rebound::velocityOf(const Touch& t, const Motion& a, const Motion& b) const {
  const Vector3 ofA = a.velocity + a.spin.cross(t.armA);
  if (wholePieceOf(t.b) == kNone) return ofA - t.outside;
  return ofA - b.velocity - b.spin.cross(t.armB);
}

Vector3 Rebound::velocityOf(const Touch& t) const {
  const uint32_t a = m_pieceOf[t.a], b = wholePieceOf(t.b);
  return velocityOf(t, m_pieces[a].motion, m_pieces[b == kNone ? a : b].motion);
}

/// Generalised inverse mass along a vector, times its square, 1/kg.
double Rebound::responseOf(const Touch& t, const Vector3& along) const {
  const auto of = [&](uint32_t piece, const Vector3& arm) {
    const MassSpread& spread = m_pieces[piece].spread;
    const Vector3 lever = arm.cross(along);
    return along.squaredNorm() / spread.mass + lever.dot(spread.inverseInertia * lever);
  };
  const uint32_t b = wholePieceOf(t.b);
  return of(m_pieceOf[t.a], t.armA) + (b == kNone ? 0 : of(b, t.armB));
}

/// Impulse on a in kg m/s.
void Rebound::give(const Touch& t, const Vector3& impulse) {
  const auto to = [&](uint32_t index, const Vector3& arm, const Vector3& given) {
    Piece& piece = m_pieces[index];
    piece.motion.velocity += given / piece.spread.mass;
    piece.motion.spin += piece.spread.inverseInertia * arm.cross(given);
  };
  to(m_pieceOf[t.a], t.armA, impulse);
  if (const uint32_t b = wholePieceOf(t.b); b != kNone) to(b, t.armB, -impulse);
}

/// Normal impulses stay positive, friction within the cone.
void Rebound::solve(std::span<Touch> touches) {
  double fastest = 0;
  for (const Touch& t : touches) fastest = std::max(fastest, -t.approach);
  for (int pass = 0; pass < kPasses; ++pass) {
    double most = 0;
    for (Touch& t : touches) {
      const double before = t.impulse;
      t.impulse = std::max(0.0, before + (t.wanted() - velocityOf(t).dot(t.normal)) * t.mass);
      give(t, (t.impulse - before) * t.normal);
      most = std::max(most, std::abs(t.impulse - before) / t.mass);
      const Vector3 speed = velocityOf(t), slip = speed - speed.dot(t.normal) * t.normal;
      if (!(t.friction > 0) || !(slip.squaredNorm() > 0)) continue;
      Vector3 rub = t.rub - slip.squaredNorm() / responseOf(t, slip) * slip;
      const double size = rub.norm(), limit = t.friction * t.impulse;
      if (size > limit) rub *= limit / size;
      give(t, rub - t.rub);
      t.rub = rub;
    }
    if (!(most > kSettled * fastest)) break;
  }
}

/// Where what touches parts faster than it should in the mean, as its structure came back, it shall not.
void Rebound::holdBack(std::span<Touch> touches) {
  const auto excess = [&] {
    double sum = 0;
    for (const Touch& t : touches) sum += velocityOf(t).dot(t.normal) - t.wanted();
    return sum / static_cast<double>(touches.size());
  };
  const double before = excess();
  if (!(before > 0)) return;
  double mass = 0;
  for (const Touch& t : touches) mass += t.mass / static_cast<double>(touches.size());
  const double share = before * mass / static_cast<double>(touches.size());
  for (const Touch& t : touches) give(t, -share * t.normal);
  const double changed = before - excess();
  const double rest = changed > 0.1 * before ? before / changed - 1 : -1;
  for (Touch& t : touches) {
    give(t, -rest * share * t.normal);
    t.impulse -= (1 + rest) * share;
  }
}

/// The work of the impulses, against the mean of the speeds before and after, is what they add to the energy: what the
/// two have not lost since they met is left out of them.
void Rebound::takeGain(const Encounter& e, std::span<Touch> touches, const Vector3& frame) {
  double work = 0, change = 0;
  for (const Touch& t : touches) {
    const uint32_t a = m_pieceOf[t.a], b = wholePieceOf(t.b);
    const Vector3 impulse = t.impulse * t.normal + t.rub,
                  before = velocityOf(t, m_pieces[a].before, m_pieces[b == kNone ? a : b].before);
    work += impulse.dot(before);
    change += 0.5 * impulse.dot(velocityOf(t) - before);
  }
  const double room = std::max(0.0, e.kinetic - kineticOf(e, frame));
  if (!(change > 0) || work + change <= room) return;
  // The larger root of change s^2 + work s = room.
  const double share = std::clamp((-work + std::sqrt(work * work + 4 * change * room)) / (2 * change), 0.0, 1.0);
  for (Touch& t : touches) {
    give(t, (share - 1) * (t.impulse * t.normal + t.rub));
    t.impulse *= share;
    t.rub *= share;
  }
}

void Rebound::hand(ParticleStore& store, uint32_t index) {
  if (index == kNone) return;
  Piece& piece = m_pieces[index];
  const Vector3 shift = piece.motion.velocity - piece.before.velocity, turn = piece.motion.spin - piece.before.spin;
  if (shift.isZero(0) && turn.isZero(0)) return;
  forMembers(piece.members, [&](uint32_t i) {
    const Vector3 arm = vectorOf(store.position()[i]) - piece.spread.centre;
    addTo(store.velocity()[i], shift + turn.cross(arm));
  });
  piece.readAt = 0;
}

/// Brings all that touches to the speed at which it parts, or, `again`, only holds it back.
void Rebound::settle(ParticleStore& store, const Encounter& e, std::span<Touch> touches, bool again) {
  for (Touch& t : touches) t.impulse = 0, t.rub.setZero();
  if (!again) solve(touches);
  holdBack(touches);
  takeGain(e, touches, e.pieceB == kNone ? touches[0].outside : Vector3::Zero());
  for (const Touch& t : touches) {
    if (e.pieceB != kNone) break;
    const Vector3 impulse = t.impulse * t.normal + t.rub;
    m_externalImpulse.add(impulse);
    const int slot = t.b == kNone ? m_reactions->ofWall(t.plane) : m_reactions->ofBody(store.body()[t.b]);
    m_reactions->add(slot, m_pieces[e.pieceA].spread.centre + t.armA, -impulse);
  }
  hand(store, e.pieceA);
  hand(store, e.pieceB);
}

}  // namespace ps
