// SPDX-License-Identifier: Apache-2.0
#include "core/solver/frame/prescribedmotion.h"

#include "core/base/statestream.h"
#include "core/solver/truesurface.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

constexpr size_t kNumbers = 27;                     // of a frame
constexpr size_t kLeadNumbers = 8;                  // of the way that a hand leads it
constexpr double kFollowed = 0.5;                   // of that way in a frame
constexpr double kFastestHand = 20;                 // m/s
constexpr double kArrived = 1e-4;                   // of its size, that a body goes at once
constexpr double kNothing = 1e-7;                   // m, likewise
constexpr const char* kPlace = "prescribed_place";  // w: 1 when it has been taken
constexpr const char* kLeads = "motion/leads";      // where a hand leads one

bool rests(const BodyMotion& motion) {
  const Vector3 v = vectorOf(motion.velocity), w = vectorOf(motion.spin);
  return v.squaredNorm() == 0 && w.squaredNorm() == 0;
}

/// Seconds of the `dt` after `time` in which a body is on its way.
double secondsWithin(const BodyMotion& motion, double time, double dt) {
  return std::clamp(std::min(motion.stop, time + dt) - std::max(motion.start, time), 0.0, dt);
}

/// Turns a unit quaternion by the angle |v| in rad about v.
void turnBy(Quaternion& q, const Vector3& v) {
  // Halved until the series of sine and cosine are exact to 1e-16, then squared as often.
  int halvings = 0;
  double scale = 0.5;
  for (double angle2 = 0.25 * v.squaredNorm(); angle2 > 0.01 && halvings < 40; angle2 *= 0.25, scale *= 0.5) ++halvings;
  const double s = scale * scale * v.squaredNorm();
  Quaternion turn;
  turn.vec() = scale * (1 - s / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72)))) * v;
  turn.w() = 1 - s / 2 * (1 - s / 12 * (1 - s / 30 * (1 - s / 56)));
  for (; halvings > 0; --halvings) turn = turn * turn;
  q = (turn * q).normalized();
}

/// A share, 0 .. 1, of a turn by less than a half, about its axis.
Quaternion shareOf(const Quaternion& turn, double share) {
  const double sign = turn.w() < 0 ? -share : share;
  Quaternion part;
  part.vec() = sign * turn.vec();
  part.w() = 1 - share + sign * turn.w();
  return part.normalized();
}

/// rad about its axis, of a turn by no more than a right angle: by the series of the arc sine, to 1e-3.
Vector3 angleOf(const Quaternion& turn) {
  const double x = turn.vec().squaredNorm();
  const Vector3 half = (1 + x * (1.0 / 6 + x * (3.0 / 40 + x * (15.0 / 336 + x * (105.0 / 3456))))) * turn.vec();
  return (turn.w() < 0 ? -2 : 2) * half;
}

api::Float4* placesIn(ParticleStore& store) {
  return static_cast<api::Float4*>(store.find(kPlace, api::FieldType::Float4));
}

}  // namespace

void PrescribedMotion::set(uint32_t body, const BodyMotion& motion, ParticleStore& store) {
  if (body < m_frames.size() && m_frames[body].exists) {
    m_frames[body].motion = motion;
    return;
  }
  if (!rests(motion)) makeFrame(body, motion, store);
}

void PrescribedMotion::makeFrame(uint32_t body, const BodyMotion& motion, ParticleStore& store) {
  store.declare(kPlace, api::FieldType::Float4, "m", "Place in the frame of a body whose motion is prescribed");
  if (m_frames.size() <= body) m_frames.resize(body + size_t{1});
  Frame& frame = m_frames[body];
  frame.motion = motion;
  frame.centre = frame.origin = vectorOf(motion.centre);
  frame.axes = frame.turn.toRotationMatrix();
  frame.exists = true;
  auto* surface = static_cast<api::Float4*>(store.find(field::kTrueSurface, api::FieldType::Float4));
  for (size_t i = 0; i < store.size(); ++i) {
    if (store.body()[i] != body) continue;
    adopt(store, i, i + 1, -1);
    if (surface) surface[i] = {0, 0, 0, 0};  // it is of shapes that stand
  }
}

const PrescribedMotion::Frame* PrescribedMotion::frameOf(const ParticleStore& store, size_t i) const {
  const uint32_t body = store.body()[i];
  const bool led = body < m_frames.size() && m_frames[body].exists && store.motion()[i] == api::Motion::Static;
  return led ? &m_frames[body] : nullptr;
}

void PrescribedMotion::adopt(ParticleStore& store, size_t first, size_t last, double time) const {
  api::Float4* places = placesIn(store);
  for (size_t i = first; i < last; ++i) {
    const Frame* frame = frameOf(store, i);
    if (!frame) continue;
    const Vector3 arm = vectorOf(store.position()[i]) - frame->centre;
    places[i] = float4Of(frame->axes.transpose() * arm, 1);
    const BodyMotion& motion = frame->motion;
    const bool moves = motion.start <= time && time < motion.stop;
    Vector3 v;
    if (moves) v = vectorOf(motion.velocity) + vectorOf(motion.spin).cross(arm);
    store.velocity()[i] = float4Of(v, 0);
  }
}

void PrescribedMotion::carry(uint32_t body, const RigidMove& move) {
  if (body >= m_frames.size() || !m_frames[body].exists) return;
  Frame& frame = m_frames[body];
  frame.centre = move.of(frame.centre);
  frame.origin = move.of(frame.origin);
  if (move.turns()) frame.turn = (move.turn * frame.turn).normalized();
  frame.axes = frame.turn.toRotationMatrix();
  frame.lead.way = move.turn * frame.lead.way;
  if (move.turns()) frame.lead.turn = (move.turn * frame.lead.turn * move.turn.conjugate()).normalized();
}

void PrescribedMotion::follow(uint32_t body, const Vector3& centre, const Quaternion& turn, const Vector3& way,
                              ParticleStore& store) {
  if (body >= m_frames.size() || !m_frames[body].exists) makeFrame(body, {double3Of(centre), {}, {}}, store);
  Frame& frame = m_frames[body];
  Lead& lead = frame.lead;
  api::Float4 arm = float4Of(centre - frame.centre, 0);
  store.period().shorten(arm.x, arm.y, arm.z);
  // The frame's centre about that of the mass, where the way ends.
  const Vector3 about = -(lead.turn * vectorOf(arm));
  lead.way += way + turn * about - about;
  lead.turn = (turn * lead.turn).normalized();
  const api::Float4* places = placesIn(store);
  double farthest = 0;
  for (size_t i = 0; i < store.size(); ++i) {
    if (frameOf(store, i) == &frame) farthest = std::max(farthest, vectorOf(places[i]).squaredNorm());
  }
  lead.radius = std::sqrt(farthest);
}

double PrescribedMotion::leftOf(uint32_t body) const {
  return body < m_frames.size() && m_frames[body].exists ? m_frames[body].lead.longest() : 0;
}

double PrescribedMotion::wayOf(const Frame& frame, double dt) {
  const double longest = frame.exists ? frame.lead.longest() : 0;
  return longest <= std::max(kArrived * frame.lead.radius, kNothing) ? longest
                                                                     : std::min(kFollowed * longest, kFastestHand * dt);
}

double PrescribedMotion::nextWay(double dt) const {
  double most = 0;
  for (const Frame& frame : m_frames) most = std::max(most, wayOf(frame, dt));
  return most;
}

void PrescribedMotion::startFrame(int substeps, double dt, double most) {
  for (Frame& frame : m_frames) {
    frame.part = {};
    if (!frame.exists || !frame.lead.any()) continue;
    const double longest = frame.lead.longest(), way = std::min(wayOf(frame, dt), most);
    frame.part.arrives = !(way < longest);
    const double share = frame.part.arrives ? 1 : way / longest;
    frame.part.way = share / substeps * frame.lead.way;
    frame.part.turn = shareOf(frame.lead.turn, share);
    frame.part.substeps = substeps;
  }
}

/// A substep of `dt` s of what startFrame() has planned.
void PrescribedMotion::stepLead(Frame& frame, double dt) {
  LeadPart& part = frame.part;
  if (part.substeps == 0) return;
  const Quaternion turn = shareOf(part.turn, 1.0 / part.substeps);
  part.turn = (part.turn * turn.conjugate()).normalized();
  frame.centre += part.way;
  frame.turn = (turn * frame.turn).normalized();
  frame.velocity += part.way / dt;
  frame.spin += angleOf(turn) / dt;
  frame.lead.way -= part.way;
  frame.lead.turn = (frame.lead.turn * turn.conjugate()).normalized();
  if (--part.substeps == 0 && part.arrives) frame.lead = {};
}

bool PrescribedMotion::movesWithin(double time, double dt) const {
  return std::any_of(m_frames.begin(), m_frames.end(), [&](const Frame& frame) {
    if (!frame.exists) return false;
    return frame.lead.any() || (!rests(frame.motion) && secondsWithin(frame.motion, time, dt) > 0);
  });
}

void PrescribedMotion::putBack(ParticleStore& store, size_t first, size_t last) const {
  for (size_t i = first; i < last; ++i) {
    const Frame* frame = frameOf(store, i);
    if (!frame || placesIn(store)[i].w != 0) continue;
    placesIn(store)[i] = float4Of(vectorOf(store.position()[i]) - frame->origin, 1);
  }
  lead(store, first, last);
  std::copy(store.position() + first, store.position() + last, store.previous() + first);
}

void PrescribedMotion::advance(const Period& period, double time, double dt) {
  for (Frame& frame : m_frames) {
    if (!frame.exists) continue;
    const double seconds = secondsWithin(frame.motion, time, dt);
    const Vector3 way = seconds * vectorOf(frame.motion.velocity), turn = seconds * vectorOf(frame.motion.spin);
    frame.centre += way;
    turnBy(frame.turn, turn);
    frame.velocity = way / dt;
    frame.spin = turn / dt;
    stepLead(frame, dt);
    frame.centre = vectorOf(period.wrapped(double3Of(frame.centre)));
    frame.axes = frame.turn.toRotationMatrix();
  }
}

void PrescribedMotion::lead(ParticleStore& store, size_t first, size_t last) const {
  if (m_frames.empty()) return;
  const api::Float4* places = placesIn(store);
  const Period& period = store.period();
  const auto coordinate = [&](double to, float from, size_t axis) {
    const double length = period.length(axis);
    return static_cast<float>(length > 0 ? to - length * std::floor((to - double{from}) / length + 0.5) : to);
  };
  for (size_t i = first; i < last; ++i) {
    const Frame* frame = frameOf(store, i);
    if (!frame) continue;
    const Vector3 arm = frame->axes * vectorOf(places[i]), to = frame->centre + arm;
    api::Float4& x = store.position()[i];
    const api::Float4& from = store.previous()[i];
    x.x = coordinate(to.x(), from.x, 0), x.y = coordinate(to.y(), from.y, 1), x.z = coordinate(to.z(), from.z, 2);
    store.velocity()[i] = float4Of(frame->velocity + frame->spin.cross(arm), 0);
  }
}

/// Every number of the frames that is carried on, in order; the matrix follows from the turn.
template <class Frames, class Visit>
void PrescribedMotion::eachNumber(Frames& frames, Visit&& visit) {
  const auto each = [&](auto& v) { visit(v.x), visit(v.y), visit(v.z); };
  for (auto& frame : frames) {
    each(frame.motion.centre), each(frame.motion.velocity), each(frame.motion.spin);
    visit(frame.motion.start), visit(frame.motion.stop);
    for (auto* v : {&frame.centre, &frame.origin, &frame.velocity, &frame.spin}) {
      for (auto& c : *v) visit(c);
    }
    for (Eigen::Index k = 0; k < 4; ++k) visit(frame.turn.coeffs()[k]);
  }
}

template <class Frames, class Visit>
void PrescribedMotion::eachLead(Frames& frames, Visit&& visit) {
  for (auto& frame : frames) {
    for (auto& c : frame.lead.way) visit(c);
    for (Eigen::Index k = 0; k < 4; ++k) visit(frame.lead.turn.coeffs()[k]);
    visit(frame.lead.radius);
  }
}

void PrescribedMotion::save(StateWriter& writer) const {
  writer.open("motion/exists", StateType::UInt8, m_frames.size());
  for (const Frame& frame : m_frames) writer.put(static_cast<uint8_t>(frame.exists ? 1 : 0));
  writer.close();
  writer.open("motion/frames", StateType::Float64, kNumbers * m_frames.size());
  eachNumber(m_frames, [&](const double& number) { writer.put(number); });
  writer.close();
  if (std::none_of(m_frames.begin(), m_frames.end(), [](const Frame& frame) { return frame.lead.any(); })) return;
  writer.open(kLeads, StateType::Float64, kLeadNumbers * m_frames.size());
  eachLead(m_frames, [&](const double& number) { writer.put(number); });
  writer.close();
}

void PrescribedMotion::restore(const StateReader& reader, const ParticleStore& store) {
  const std::vector<uint8_t> exists = reader.array<uint8_t>("motion/exists");
  StateRuns<double> numbers(reader, "motion/frames");
  m_frames.assign(exists.size(), {});
  eachNumber(m_frames, [&](double& number) { number = numbers.next(1)[0]; });
  numbers.done();
  if (reader.has(kLeads)) {
    StateRuns<double> leads(reader, kLeads);
    eachLead(m_frames, [&](double& number) { number = leads.next(1)[0]; });
    leads.done();
  }
  for (size_t body = 0; body < m_frames.size(); ++body) {
    m_frames[body].exists = exists[body] != 0;
    m_frames[body].axes = m_frames[body].turn.toRotationMatrix();
    if (exists[body] != 0 && !store.read(kPlace, api::FieldType::Float4))
      StateReader::fail("motion/frames", "has bodies whose places are missing");
  }
}

}  // namespace ps
