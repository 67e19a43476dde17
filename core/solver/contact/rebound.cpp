// SPDX-License-Identifier: Apache-2.0
#include "core/solver/contact/rebound.h"

#include "core/base/parallelarrays.h"
#include "core/base/statestream.h"
#include "core/solver/contact/membersums.h"
#include "core/solver/structure/piecelists.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace ps {
namespace {

/// s: what has not rebounded after this has come to rest in another way, and what has is held back no longer.
constexpr double kLongest = 0.25;
/// Shares of the fastest approach: a piece is pushed no more when its speed grows by less in a substep, and its way in
/// is over below the second.
constexpr double kPushed = 1e-3, kStopped = 0.02;
/// Change of the mean square radius, as a share, from which on a piece has lost its shape.
constexpr double kLostShape = 1.0 / 3;
/// Farther apart than this, in spacings beyond contact, two do not touch.
constexpr double kApart = 0.1;
/// Share of its restitution from which on an impact has delivered it.
constexpr double kDelivered = 0.9;
/// Numbers of an encounter and of a touch that go on into the next frame.
constexpr size_t kMarks = 4, kNumbers = 16, kTouchNumbers = 6;

}  // namespace

void Rebound::configure(const SolverSettings& settings, const std::vector<Wall>& walls,
                        std::span<const BakedMaterial> materials) {
  m_dt = settings.dt / settings.substeps;
  m_spacing = settings.spacing;
  m_gravity = vectorOf(settings.gravity);
  m_slowest = 2 * m_gravity.norm() * m_dt;
  std::swap(m_walls, m_wallsBefore);
  findContactFaces(walls, settings.spacing, m_walls);
  if (m_walls != m_wallsBefore)
    std::erase_if(m_touches, [](const Touch& t) { return t.plane != kNone; });  // that may be others by now
  m_wallFriction.clear();
  for (const Wall& w : walls) m_wallFriction.push_back(w.friction);
  m_materials.resize(materials.size());
  for (size_t k = 0; k < materials.size(); ++k) {
    Bounce& bounce = m_materials[k];
    bounce.friction = materials[k].scalar(propertyIndex("friction_kinetic"));
    const double restitution = materials[k].scalar(propertyIndex("restitution"));
    if (restitution != bounce.restitution || materials[k].id() != bounce.id) bounce.asked = bounce.delivered = 0;
    bounce.id = materials[k].id();
    bounce.restitution = restitution;
  }
}

void Rebound::findPieces(const ParticleStore& store, const Structure& structure) {
  m_stale = false;
  m_anySoft = false;
  const PieceLists& lists = structure.pieces;
  lengthen(m_pieceOf, store.size());
  forChunks(store.size(), grain::kNumbers, [&](size_t from, size_t to) {
    for (size_t i = from; i < to; ++i) {
      const uint32_t first = structure.pieceOf[i];
      m_pieceOf[i] = first == ConstraintSystem::kNoPiece ? kNone : static_cast<uint32_t>(lists.pieceOf(first));
    }
  });
  const std::span<const uint8_t> thin = structure.constraints.thinBodies();
  const std::span<const uint32_t> bodyOf = structure.rigid.bodyOf();
  const auto breaks = [&](uint32_t i, uint32_t rigid) {
    const uint32_t body = store.body()[i];
    const bool isThin = body < thin.size() && thin[body] != 0;
    return store.velocity()[i].w == 0 || isThin || bodyOf[i] != rigid;
  };
  m_broken.assign(lists.count(), 0);
  forChunks(lists.members().size(), grain::kNumbers, [&](size_t from, size_t to) {
    lists.eachPart(from, to, [&](size_t piece, std::span<const uint32_t> members) {
      const uint32_t rigid = bodyOf[lists.members(piece)[0]];
      if (std::any_of(members.begin(), members.end(), [&](uint32_t i) { return breaks(i, rigid); }))
        std::atomic_ref(m_broken[piece]).store(1, std::memory_order_relaxed);
    });
  });
  m_pieces.resize(lists.count());
  for (size_t k = 0; k < m_pieces.size(); ++k) {
    m_pieces[k].members = lists.members(k);
    m_pieces[k].whole = m_broken[k] == 0;
    m_pieces[k].body = bodyOf[m_pieces[k].members[0]];
    m_pieces[k].readAt = 0;
  }
  for (const Piece& piece : m_pieces) m_anySoft = m_anySoft || (piece.whole && piece.body == kNone);
  findAgain(store);
}

/// Who the ids of encounters are now.
void Rebound::findAgain(const ParticleStore& store) {
  if (m_encounters.empty()) return;
  std::vector<std::pair<uint32_t, uint32_t>> found;  // id, index
  for (const Encounter& e : m_encounters) found.insert(found.end(), {{e.idA, kNone}, {e.idB, kNone}});
  for (const Touch& t : m_touches) found.insert(found.end(), {{t.idA, kNone}, {t.idB, kNone}});
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  const auto entryOf = [&](uint32_t id) {
    const auto at = std::lower_bound(found.begin(), found.end(), std::pair(id, uint32_t{0}));
    return at != found.end() && at->first == id ? at : found.end();
  };
  for (uint32_t i = 0; i < store.size(); ++i) {
    if (const auto at = entryOf(store.id()[i]); at != found.end()) at->second = i;
  }
  const auto indexOf = [&](uint32_t id) { return id == kNone ? kNone : entryOf(id)->second; };
  for (Encounter& e : m_encounters) {
    e.pieceA = wholePieceOf(indexOf(e.idA));
    e.pieceB = wholePieceOf(indexOf(e.idB));
  }
  for (Touch& t : m_touches) t.a = indexOf(t.idA), t.b = indexOf(t.idB);
}

void Rebound::read(const ParticleStore& store, uint32_t index) {
  if (index == kNone || m_pieces[index].readAt == m_now) return;
  Piece& piece = m_pieces[index];
  piece.readAt = m_now;
  piece.spread = massSpread(store, piece.members, store.position());
  struct Sums {
    Vector3 momentum, angular;
    double kinetic = 0;
    void operator+=(const Sums& other) {
      momentum += other.momentum, angular += other.angular;
      kinetic += other.kinetic;
    }
  };
  const Sums all = sumOver<Sums>(piece.members, [&](Sums& sum, uint32_t i) {
    const Vector3 v = vectorOf(store.velocity()[i]), p = double{store.mass()[i]} * v;
    sum.momentum += p;
    sum.angular += (vectorOf(store.position()[i]) - piece.spread.centre).cross(p);
    sum.kinetic += 0.5 * p.dot(v);
  });
  piece.kinetic = all.kinetic;
  piece.motion = {all.momentum / piece.spread.mass, piece.spread.inverseInertia * all.angular};
  piece.before = piece.motion;
}

/// J, of the particles of both, in the frame of what is fixed.
double Rebound::kineticOf(const Encounter& e, const Vector3& frame) const {
  double sum = 0;
  for (const uint32_t index : {e.pieceA, e.pieceB}) {
    if (index == kNone) continue;
    const Piece& p = m_pieces[index];
    sum += p.kinetic + p.spread.mass * frame.dot(0.5 * frame - p.before.velocity);
  }
  return sum;
}

/// The encounter of a touch, which turns it round where needed; a new one where there is none.
uint32_t Rebound::encounterOf(const ParticleStore& store, Touch& t) {
  const uint32_t a = m_pieceOf[t.a], b = wholePieceOf(t.b);
  for (size_t k = 0; k < m_encounters.size(); ++k) {
    Encounter& e = m_encounters[k];
    const bool turned = b != kNone && e.pieceA == b && e.pieceB == a;
    if (!turned && (e.pieceA != a || e.pieceB != b)) continue;
    if (e.settled > 0) {  // that impact is over
      e.pieceA = kNone;
      continue;
    }
    if (!turned) return static_cast<uint32_t>(k);
    std::swap(t.a, t.b);
    std::swap(t.idA, t.idB);
    t.normal = -t.normal;
    place(store, t);
    return static_cast<uint32_t>(k);
  }
  Encounter e;
  e.pieceA = a, e.pieceB = b;
  e.idA = t.idA;
  e.a = m_pieces[a].motion;
  e.gyrationA = m_pieces[a].spread.gyration2;
  if (b != kNone) {
    e.idB = t.idB;
    e.b = m_pieces[b].motion;
    e.gyrationB = m_pieces[b].spread.gyration2;
  }
  m_encounters.push_back(e);
  return static_cast<uint32_t>(m_encounters.size() - 1);
}

void Rebound::add(const ParticleStore& store, const Impacts::Impact& k, size_t known) {
  const bool toWall = k.b == kNone;
  Touch t;
  t.a = k.a, t.b = k.b, t.plane = k.plane;
  t.idA = store.id()[k.a], t.idB = toWall ? kNone : store.id()[k.b];
  t.normal = k.normal;
  t.restitution = k.restitution;
  const auto frictionOf = [&](uint32_t p) {
    return store.material()[p] < m_materials.size() ? m_materials[store.material()[p]].friction : 0;
  };
  t.friction = toWall ? m_wallFriction[k.plane] : 0.5 * (frictionOf(k.a) + frictionOf(k.b));
  read(store, m_pieceOf[t.a]);
  read(store, wholePieceOf(t.b));
  place(store, t);
  // What falls onto something fixed has not yet the speed that gravity gives after they meet.
  const bool fixed = wholePieceOf(t.b) == kNone;
  const Vector3 later = fixed ? Vector3((1 - k.time) * m_dt * m_gravity) : Vector3::Zero();
  const size_t before = m_encounters.size();
  if (!((velocityOf(t) - later).dot(t.normal) < -m_slowest) && !isMet(t)) return;
  t.encounter = encounterOf(store, t);
  Encounter& e = m_encounters[t.encounter];
  const bool isNew = m_encounters.size() > before;
  if (isNew && fixed) {
    const Piece& piece = m_pieces[e.pieceA];
    e.kinetic = kineticOf(e, t.outside) - piece.spread.mass * later.dot(piece.motion.velocity - t.outside);
    e.a.velocity -= later;
  } else if (isNew) {
    e.kinetic = kineticOf(e, Vector3::Zero());
  }
  // What touches while the impact lasts would have met at the speed of its beginning.
  t.approach = velocityOf(t, e.a, e.b).dot(t.normal);
  if (!(t.approach < -m_slowest)) return;
  if (isNew) e.speed = t.approach;
  const auto byKey = [](const Touch& x, const Touch& y) { return x.key() < y.key(); };
  const auto last = m_touches.begin() + static_cast<ptrdiff_t>(known);
  if (!std::binary_search(m_touches.begin(), last, t, byKey)) m_touches.push_back(t);
}

/// Whether the two that touch are in an impact already.
bool Rebound::isMet(const Touch& t) const {
  const uint32_t a = m_pieceOf[t.a], b = wholePieceOf(t.b);
  return std::any_of(m_encounters.begin(), m_encounters.end(), [&](const Encounter& e) {
    return e.settled == 0 && ((e.pieceA == a && e.pieceB == b) || (b != kNone && e.pieceA == b && e.pieceB == a));
  });
}

void Rebound::meet(const ParticleStore& store, const Structure& structure, Impacts& impacts) {
  if (impacts.found().empty() && !structure.rigid.any()) return;
  if (m_stale) findPieces(store, structure);
  if (!m_anySoft) return;
  ++m_now;
  const size_t known = m_touches.size();
  for (Impacts::Impact& k : impacts.found()) {
    const bool fixed = k.b == kNone || store.velocity()[k.b].w == 0;
    const uint32_t a = wholePieceOf(k.a), b = fixed ? kNone : wholePieceOf(k.b);
    if (a == kNone || (!fixed && b == kNone) || a == b) continue;
    add(store, k, known);
    k.restitution = 0;
    k.loose = false;
  }
  addRigid(store, structure.rigid, known);
  if (m_touches.size() > known) sortTouches();
}

/// What soft pieces and rigid bodies will meet of each other.
void Rebound::addRigid(const ParticleStore& store, const RigidContact& rigid, size_t known) {
  rigid.forFree([&](uint32_t member, uint32_t soft, const Vector3& normal, double distance, double restitution) {
    if (wholePieceOf(soft) == kNone || wholePieceOf(member) == kNone) return;
    if (!(vectorOf(store.separation(member, soft)).dot(normal) < distance)) return;
    add(store, {soft, member, kNone, 1, -normal, 0, restitution, false, false}, known);
  });
}

void Rebound::sortTouches() {
  // A rigid body may touch a particle along several faces: the fastest counts.
  const auto order = [](const Touch& t) {
    return std::tuple(t.key(), t.approach, t.normal.x(), t.normal.y(), t.normal.z());
  };
  std::sort(m_touches.begin(), m_touches.end(), [&](const Touch& x, const Touch& y) { return order(x) < order(y); });
  m_touches.erase(std::unique(m_touches.begin(), m_touches.end(),
                              [](const Touch& x, const Touch& y) { return x.key() == y.key(); }),
                  m_touches.end());
}

bool Rebound::keptShape(const Encounter& e) const {
  const auto kept = [&](uint32_t piece, double before) {
    return piece == kNone || std::abs(m_pieces[piece].spread.gyration2 - before) < kLostShape * before;
  };
  return kept(e.pieceA, e.gyrationA) && kept(e.pieceB, e.gyrationB);
}

bool Rebound::touches(const ParticleStore& store, const Touch& t) const {
  if (t.b == kNone && t.plane >= m_walls.size()) return false;
  const double gap = t.b == kNone ? m_walls[t.plane].heightOf(vectorOf(store.position()[t.a]))
                                  : vectorOf(store.separation(t.a, t.b)).dot(t.normal) - kFaceDistance * m_spacing;
  return gap < kApart * m_spacing;
}

/// What the impact has delivered of its restitution, for limits().
void Rebound::note(const ParticleStore& store, std::span<const Touch> touches) {
  double parted = 0, asked = 0, met = 0;
  for (const Touch& t : touches) {
    parted += velocityOf(t).dot(t.normal);
    asked += t.wanted();
    met -= t.approach;
  }
  const Touch& t = touches[0];
  for (const uint32_t p : {t.a, t.b}) {
    if (p == kNone || store.material()[p] >= m_materials.size()) continue;
    Bounce& bounce = m_materials[store.material()[p]];
    if (bounce.restitution != t.restitution) continue;  // the other's is greater
    const bool missed = parted < kDelivered * asked && asked > 0;
    bounce.asked = missed ? asked / met : 0;
    bounce.delivered = missed ? std::max(0.0, parted / met) : 0;
  }
}

void Rebound::limits(std::vector<Limit>& out) const {
  for (const Bounce& bounce : m_materials) {
    if (bounce.asked > 0) out.push_back({bounce.id + ".restitution", bounce.asked, bounce.delivered, ""});
  }
}

/// Goes on with an impact; returns whether it is over.
bool Rebound::goOn(ParticleStore& store, Encounter& e, std::span<Touch> all) {
  if (all.empty() || e.pieceA == kNone || (e.idB != kNone && e.pieceB == kNone)) return true;
  read(store, e.pieceA);
  read(store, e.pieceB);
  double speed = 0, fastest = 0;
  bool touching = false;
  for (Touch& t : all) {
    place(store, t);
    speed += velocityOf(t).dot(t.normal) / static_cast<double>(all.size());
    fastest = std::max(fastest, -t.approach);
    touching = touching || touches(store, t);
  }
  const bool tooLong = ++e.steps * m_dt > kLongest;
  if (e.settled > 0) {
    if (!touching || tooLong) return true;
    settle(store, e, all, true);
    return false;
  }
  const bool pushed = speed > e.speed + kPushed * fastest;
  const bool stopped = speed > -std::max(m_slowest, kStopped * fastest);
  e.speed = speed;
  // What touches no more is pushed no more, though its turning may bring the places of touch apart ever faster.
  const bool goesOn = !stopped || (pushed && touching);
  if (goesOn && !tooLong) return false;
  const bool rebounds = !tooLong && keptShape(e);
  if (rebounds) settle(store, e, all, false);
  note(store, all);
  e.settled = 1;
  return !rebounds;
}

void Rebound::part(ParticleStore& store, const Structure& structure) {
  if (m_encounters.empty()) return;
  if (m_stale) findPieces(store, structure);
  ++m_now;
  std::erase_if(m_touches, [&](const Touch& t) {
    const Encounter& e = m_encounters[t.encounter];
    if (t.a == kNone || (t.idB != kNone && t.b == kNone)) return true;               // gone
    if (e.idB == kNone && t.b != kNone && store.velocity()[t.b].w > 0) return true;  // fixed no more
    return e.pieceA != wholePieceOf(t.a) || e.pieceB != wholePieceOf(t.b);
  });
  uint32_t kept = 0;
  size_t first = 0, end = 0;
  for (uint32_t k = 0; k < m_encounters.size(); ++k) {
    size_t last = first;
    while (last < m_touches.size() && m_touches[last].encounter == k) ++last;
    const bool over = goOn(store, m_encounters[k], std::span(m_touches).subspan(first, last - first));
    if (!over) {
      m_encounters[kept] = m_encounters[k];
      for (size_t t = first; t < last; ++t, ++end) m_touches[end] = m_touches[t], m_touches[end].encounter = kept;
      ++kept;
    }
    first = last;
  }
  m_encounters.resize(kept);
  m_touches.resize(end);
}

template <class AnEncounter, class Visit>
void Rebound::eachNumber(AnEncounter& e, Visit&& visit) {
  visit(e.kinetic), visit(e.gyrationA), visit(e.gyrationB), visit(e.speed);
  for (auto* v : {&e.a.velocity, &e.a.spin, &e.b.velocity, &e.b.spin}) {
    for (auto& c : *v) visit(c);
  }
}

void Rebound::forget(const ParticleStore& store, std::span<const uint8_t> goes) {
  const auto gone = [&](uint32_t id) {
    const size_t i = id == kNone ? store.size() : store.indexOf(id);
    return i < store.size() && goes[i] != 0;
  };
  std::vector<uint32_t> place(m_encounters.size(), kNone);
  std::vector<Encounter> left;
  for (size_t k = 0; k < m_encounters.size(); ++k) {
    if (gone(m_encounters[k].idA) || gone(m_encounters[k].idB)) continue;
    place[k] = static_cast<uint32_t>(left.size());
    left.push_back(m_encounters[k]);
  }
  m_encounters = std::move(left);
  std::erase_if(m_touches, [&](const Touch& t) { return place[t.encounter] == kNone; });
  for (Touch& t : m_touches) t.encounter = place[t.encounter];
}

void Rebound::save(StateWriter& writer) const {
  if (m_encounters.empty()) return;
  writer.open("rebound/encounters", StateType::UInt32, kMarks * m_encounters.size());
  for (const Encounter& e : m_encounters) {
    for (const uint32_t mark : {e.idA, e.idB, e.steps, e.settled}) writer.put(mark);
  }
  writer.close();
  writer.open("rebound/numbers", StateType::Float64, kNumbers * m_encounters.size());
  for (const Encounter& e : m_encounters) eachNumber(e, [&](const double& number) { writer.put(number); });
  writer.close();
  writer.open("rebound/touches", StateType::UInt32, kMarks * m_touches.size());
  for (const Touch& t : m_touches) {
    for (const uint32_t mark : {t.encounter, t.idA, t.idB, t.plane}) writer.put(mark);
  }
  writer.close();
  writer.open("rebound/speeds", StateType::Float64, kTouchNumbers * m_touches.size());
  for (const Touch& t : m_touches) {
    for (const double number : {t.normal.x(), t.normal.y(), t.normal.z(), t.approach, t.restitution, t.friction})
      writer.put(number);
  }
  writer.close();
}

void Rebound::restore(const StateReader& reader) {
  m_encounters.clear();
  m_touches.clear();
  m_stale = true;
  for (Bounce& bounce : m_materials) bounce.asked = bounce.delivered = 0;
  if (!reader.has("rebound/encounters")) return;  // nothing was meeting
  const std::vector<uint32_t> marks = reader.array<uint32_t>("rebound/encounters");
  const std::vector<uint32_t> touches = reader.array<uint32_t>("rebound/touches");
  if (marks.size() % kMarks != 0) StateReader::fail("rebound/encounters", "ends amid an encounter");
  if (touches.size() % kMarks != 0) StateReader::fail("rebound/touches", "ends amid a touch");
  StateRuns<double> numbers(reader, "rebound/numbers"), speeds(reader, "rebound/speeds");
  for (size_t k = 0; k < marks.size(); k += kMarks) {
    Encounter& e = m_encounters.emplace_back();
    e.idA = marks[k], e.idB = marks[k + 1], e.steps = marks[k + 2], e.settled = marks[k + 3];
    eachNumber(e, [&](double& number) { number = numbers.next(1)[0]; });
  }
  for (size_t k = 0; k < touches.size(); k += kMarks) {
    Touch& t = m_touches.emplace_back();
    t.encounter = touches[k], t.idA = touches[k + 1], t.idB = touches[k + 2], t.plane = touches[k + 3];
    if (t.encounter >= m_encounters.size())
      StateReader::fail("rebound/touches", "names an encounter that is not there");
    const auto read = speeds.next(kTouchNumbers);
    t.normal = {read[0], read[1], read[2]};
    t.approach = read[3], t.restitution = read[4], t.friction = read[5];
  }
  numbers.done();
  speeds.done();
}

}  // namespace ps
