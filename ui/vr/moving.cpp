// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/moving.h"

#include "ui/vr/handmodel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ps::vr {
namespace {

constexpr double kHeld = 0.5, kIdle = 0.1;                      // of a grip's way, and of a trigger's
constexpr double kPushed = 0.7;                                 // of a stick's
constexpr double kTogether = 0.3;                               // s, between two grips that are meant as one
constexpr double kTurn = std::numbers::pi / 6, kLarger = 1.25;  // of a hand that is alone: at each push
constexpr double kFarthest = 8, kSteep = 0.05;  // m, and how much a beam must fall on its way, of where one goes
constexpr double kPinches = 0.6;                // s, within which a hand that pointed pinches
constexpr double kGoalWidth = 0.2, kGoalHeight = 0.01;  // m
constexpr double kDimmed = 0.15;                        // s, after a step
constexpr double kBeforeEyes = 0.3, kReach = 0.6;       // m, of what dims
constexpr double kDarkest = 0.6;

/// Clear in its middle.
std::shared_ptr<const PanelImage> dimmer() {
  static const std::shared_ptr<const PanelImage> kImage = [] {
    constexpr int kSide = 128;
    auto image = std::make_shared<PanelImage>();
    image->width = image->height = kSide;
    image->pixels.assign(4 * kSide * kSide, 0);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const double away = std::hypot(2.0 * x / (kSide - 1) - 1, 2.0 * y / (kSide - 1) - 1);
        const double share = std::clamp((away - 0.35) / 0.4, 0.0, 1.0);
        image->pixels[static_cast<size_t>(4 * (y * kSide + x) + 3)] =
            static_cast<uint8_t>(std::lround(255 * kDarkest * share * share * (3 - 2 * share)));
      }
    return image;
  }();
  return kImage;
}

}  // namespace

void Moving::follow(const HeadsetFrame& frame, const HandRoles& roles, bool busy, const std::array<bool, 2>& keeps) {
  if (std::exchange(m_roles, roles) != roles) {
    m_goal.reset();
    m_pointed.reset();
    m_goes = false;
  }
  m_dimmed = std::max(0.0, m_dimmed - frame.period);
  carry(frame, keeps);
  turn(frame, busy);
  go(frame, busy);
}

bool Moving::isGripped(const HandInput& input) { return input.grip && input.hold > kHeld; }

/// While neither draws: then a grip means the opposite of what the brush does. A body that a hand took just before the
/// other one came is put back by whoever gave it, and loose matter let go.
void Moving::carry(const HeadsetFrame& frame, const std::array<bool, 2>& keeps) {
  const auto& [left, right] = frame.hands;
  for (const size_t hand : {kLeft, kRight}) {
    if (frame.hands[hand].hold <= kHeld)
      m_gripped[hand].reset(), m_usesGrip[hand] = false;
    else if (!m_gripped[hand] && isGripped(frame.hands[hand]))
      m_gripped[hand] = frame.time;
  }
  if (!isGripped(left) || !isGripped(right)) return m_carrying.reset();
  const bool idle = left.draw < kIdle && right.draw < kIdle, kept = keeps[kLeft] || keeps[kRight];
  const bool together = frame.time - std::min(*m_gripped[kLeft], *m_gripped[kRight]) < kTogether;
  if (!m_carrying && !(idle && (together || !kept))) return;
  m_usesGrip = {true, true};
  const std::array<Vector3, 2> hands{left.grip->position, right.grip->position};
  if (!m_carrying) m_carrying = Carrying{m_stand, hands};
  m_stand = carried(m_carrying->from, m_carrying->hands, hands);
  m_dimmed = kDimmed;
}

/// The scene goes round the other way than its wearer.
void Moving::turnBy(int64_t steps, const Vector3& about) {
  m_stand = turned(m_stand, about, kTurn * static_cast<double>(steps));
  m_dimmed = kDimmed;
}

void Moving::turn(const HeadsetFrame& frame, bool busy) {
  const HandInput& hand = frame.hands[frame.hands[m_roles.other()].pad ? m_roles.other() : m_roles.main];
  const bool aside = std::abs(hand.steerX) > kPushed && std::abs(hand.steerX) > std::abs(hand.steerY);
  const bool grips = steers(m_roles.main, hand);
  // The sides of the main hand's pad choose the shape of its brush.
  const bool free = grips ? !busy : !hand.pad || !m_roles.alone;
  const bool asked = aside && free && (!hand.pad || hand.steerPressed);
  if (asked && !m_turns && !m_carrying) {
    if (grips && !hand.pad)
      scaleBy(hand.steerX > 0 ? kLarger : 1 / kLarger, frame);
    else
      turnBy(hand.steerX > 0 ? 1 : -1, frame.head.position);
  }
  m_turns = asked;
}

/// About where the hand is, as if another one went away from it.
void Moving::scaleBy(double factor, const HeadsetFrame& frame) {
  const std::optional<HandPose>& grip = frame.hands[m_roles.main].grip;
  if (!grip) return;
  const Vector3 there = grip->position, span(1, 0, 0);
  m_stand = carried(m_stand, {there - span, there + span}, {there - factor * span, there + factor * span});
  m_dimmed = kDimmed;
}

namespace {

/// On the floor, where a hand points; nothing where that is too far, or up in the air.
std::optional<Vector3> floorAt(const HandPose& aim, const Vector3& head) {
  const Vector3 beam = aim.orientation * Vector3(0, 0, -1);
  if (beam.y() > -kSteep || aim.position.y() <= 0) return std::nullopt;
  const Vector3 on = aim.position - aim.position.y() / beam.y() * beam;
  return (on - head).norm() < kFarthest ? std::optional(on) : std::nullopt;
}

}  // namespace

void Moving::go(const HeadsetFrame& frame, bool busy) {
  const HandInput& hand = frame.hands[m_roles.goes()];
  const bool means = !m_roles.alone || steers(m_roles.main, hand);
  const bool forward = means && hand.steerY > kPushed && hand.steerY > std::abs(hand.steerX);
  const std::optional<Vector3> goal = std::exchange(m_goal, std::nullopt);
  m_goes = m_goes && hand.draw > kIdle;
  if (!hand.aim || m_carrying || busy) return m_pointed.reset();
  if (hand.points || m_pointed) return goBare(frame, goal);
  if (forward && (!hand.pad || hand.steerPressed))
    m_goal = floorAt(*hand.aim, frame.head.position);
  else if (goal)
    arriveAt(*goal, frame);
}

/// The index leaves where it points as it comes to the thumb: where it was then is meant.
void Moving::goBare(const HeadsetFrame& frame, const std::optional<Vector3>& goal) {
  const HandInput& hand = frame.hands[m_roles.goes()];
  if (hand.points) {
    m_goal = floorAt(*hand.aim, frame.head.position);
    m_pointed = frame.time;
  } else if (goal && hand.draw > kHeld) {
    m_pointed.reset();
    m_goes = true;
    arriveAt(*goal, frame);
  } else if (goal && frame.time - *m_pointed < kPinches) {
    m_goal = goal;
  } else {
    m_pointed.reset();
  }
}

void Moving::arriveAt(const Vector3& goal, const HeadsetFrame& frame) {
  const Vector3 way = goal - frame.head.position;
  m_stand.roomPlace -= Vector3(way.x(), 0, way.z());
  m_dimmed = kDimmed;
}

void Moving::addTo(Props& props, const HeadsetFrame& frame, const std::array<float, 3>& accent) const {
  const double scale = 1 / m_stand.scale;
  if (m_goal) {
    const HandPose& aim = *frame.hands[m_roles.goes()].aim;
    addBeam(props, m_stand.toScene(aim), scale, (*m_goal - aim.position).norm(), accent);
    addVolume(props, m_stand.toScene(*m_goal), {scale * Vector3(kGoalWidth, kGoalHeight, kGoalWidth), false, accent});
  }
  if (m_dimmed <= 0) return;
  const auto corner = [&](double x, double y) {
    return m_stand.toScene(
        Vector3(frame.head.position + frame.head.orientation * Vector3(x * kReach, y * kReach, -kBeforeEyes)));
  };
  props.panels.push_back({{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}, dimmer()});
}

}  // namespace ps::vr
