// SPDX-License-Identifier: Apache-2.0
#include "ui/vr/simulatedroom.h"

#include "ui/vr/handlabels.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace ps::vr {
namespace {

constexpr double kTangent = 0.75;                   // of half the picture's height
constexpr double kNear = 0.03, kFar = 100;          // m
constexpr double kSteepest = 1.4;                   // rad
constexpr double kNearest = 0.15, kFarthest = 1.5;  // m, of a hand from the eyes
constexpr double kBeforePanel = 0.06;               // m, of its tip, which would press what it is near

/// Looks along a way, upright.
Quaternion along(const Vector3& way) {
  const Vector3 back = -way.normalized();
  const Vector3 right = Vector3::UnitY().cross(back).normalized();
  Matrix3 axes;
  axes << right, back.cross(right), back;
  return Quaternion(axes);
}

}  // namespace

SimulatedRoom::SimulatedRoom() { rest(); }

/// The other hand, at its side.
void SimulatedRoom::rest() {
  const double x = m_roles.other() == kLeft ? -0.26 : 0.26;
  HandInput& other = m_hands[m_roles.other()];
  other = {};
  m_roll = {};
  other.aim = other.grip = HandPose{{x, 1.2, -0.5}, along({0, 0, -1})};
}

void SimulatedRoom::give(const HandRoles& roles) {
  if (std::exchange(m_roles, roles).main == roles.main) return;
  m_used = roles.main;
  rest();
}

HandPose SimulatedRoom::head() const {
  const double c = std::cos(m_up);
  return {m_place, along({std::sin(m_right) * c, std::sin(m_up), -std::cos(m_right) * c})};
}

Eye SimulatedRoom::eye(double aspect) const {
  const HandPose pose = head();
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = pose.orientation.toRotationMatrix();
  place.translation() = pose.position;
  const double wide = kTangent * aspect;
  return eyeThrough(place.inverse().matrix(), -wide, wide, -kTangent, kTangent, kNear, kFar);
}

HandPose SimulatedRoom::pointer(double aspect) const {
  const HandPose eyes = head();
  return {eyes.position, along(eyes.orientation * Vector3(m_x * kTangent * aspect, m_y * kTangent, -1))};
}

HeadsetFrame SimulatedRoom::frame(double seconds, double aspect) {
  const HandPose eyes = pointer(aspect);
  HandInput& used = m_hands[m_used];
  for (HandInput& hand : m_hands) hand.profile = &hand == &used ? kMouse : std::string_view();
  const double reach = m_most ? std::min(m_reach[m_used], *m_most - kBeforePanel) : m_reach[m_used];
  const Quaternion rolled(Eigen::AngleAxisd(-m_roll[m_used], Vector3::UnitZ()));
  used.aim = used.grip =
      HandPose{eyes.position - (reach - kTip) * (eyes.orientation * Vector3::UnitZ()), eyes.orientation * rolled};
  // The palm of the other hand, where that rests, faces the eyes: it holds the palette.
  const size_t other = m_roles.other();
  HandPose& palm = *m_hands[other].grip;
  const Vector3 out(other == kLeft ? 1 : -1, 0, 0);
  if (m_used != other) palm.orientation = Quaternion::FromTwoVectors(out, eyes.position - palm.position);
  HeadsetFrame frame;
  frame.time = seconds;
  frame.period = std::max(0.0, seconds - m_before);
  frame.head = head();
  frame.hands = m_hands;
  frame.focused = true;
  m_before = seconds;
  return frame;
}

void SimulatedRoom::turn(double right, double up) {
  m_right += right;
  m_up = std::clamp(m_up + up, -kSteepest, kSteepest);
}

void SimulatedRoom::walk(const Vector3& way) {
  const double c = std::cos(m_right), s = std::sin(m_right);
  m_place += Vector3(way.x() * c + way.z() * s, way.y(), way.x() * s - way.z() * c);
}

void SimulatedRoom::point(double right, double up) {
  m_x = std::clamp(right, -1.0, 1.0);
  m_y = std::clamp(up, -1.0, 1.0);
}

/// As far round as an arm turns, and a little farther.
void SimulatedRoom::roll(double right) {
  m_roll[m_used] = std::clamp(m_roll[m_used] + right, -std::numbers::pi, std::numbers::pi);
}

void SimulatedRoom::level() { m_roll[m_used] = 0; }

void SimulatedRoom::reach(double more) { m_reach[m_used] = std::clamp(m_reach[m_used] + more, kNearest, kFarthest); }

}  // namespace ps::vr
