// SPDX-License-Identifier: Apache-2.0
#include "core/scene/turnedbox.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ps {
namespace {

constexpr std::array<const char*, 3> kTurns{"rotation_x", "rotation_y", "rotation_z"};
constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kUpright = 1 - 1e-12;  ///< sine of the turn about y from which those about x and z are one
constexpr double kStraight = 1e-12;  ///< of a cosine from 0 or 1: a turn by right angles, which keeps no other digits

Vector3 rotationOf(const Sink& sink) {
  Vector3 rotation;
  for (size_t a = 0; a < 3; ++a)
    rotation[static_cast<Eigen::Index>(a)] = numberOf(sink.parameters, sinkParameters(), kTurns[a]);
  return rotation;
}

Matrix3 straightened(const Matrix3& axes) {
  const Matrix3 straight = (axes.array().round() + 0.0).matrix();  // none of them -0
  return (axes - straight).cwiseAbs().maxCoeff() < kStraight ? straight : axes;
}

double tidy(double degrees) { return std::round(degrees * 1e9) / 1e9 + 0.0; }

}  // namespace

Vector3 anglesOf(const Matrix3& m) {
  const double sine = std::clamp(-m(2, 0), -1.0, 1.0);
  if (std::abs(sine) > kUpright)
    return {0, tidy(std::copysign(90, sine)), tidy(kDegrees * std::atan2(-m(0, 1), m(1, 1)))};
  return {tidy(kDegrees * std::atan2(m(2, 1), m(2, 2))), tidy(kDegrees * std::asin(sine)),
          tidy(kDegrees * std::atan2(m(1, 0), m(0, 0)))};
}

Quaternion turnOf(const Vector3& degrees) {
  const Vector3 angle = degrees / kDegrees;
  const auto about = [&](Eigen::Index axis) { return Quaternion(Eigen::AngleAxisd(angle[axis], Vector3::Unit(axis))); };
  return (about(2) * about(1) * about(0)).normalized();
}

TurnedBox::TurnedBox(const Vector3& minimum, const Vector3& maximum, const Vector3& rotation)
    : m_minimum(minimum), m_maximum(maximum), m_rotation(rotation) {
  if (isTurned()) m_axes = straightened(turnOf(rotation).toRotationMatrix());
}

TurnedBox::TurnedBox(const Sink& sink) : TurnedBox(sink.minimum, sink.maximum, rotationOf(sink)) {}

bool TurnedBox::contains(const Vector3& place) const {
  const Vector3 p = isTurned() ? Vector3(middle() + m_axes.transpose() * (place - middle())) : place;
  return (p.array() >= m_minimum.array()).all() && (p.array() <= m_maximum.array()).all();
}

Vector3 TurnedBox::corner(int corner) const {
  Vector3 p;
  for (int a = 0; a < 3; ++a) p[a] = (corner >> a & 1) != 0 ? m_maximum[a] : m_minimum[a];
  return isTurned() ? Vector3(middle() + m_axes * (p - middle())) : p;
}

BodyBounds TurnedBox::bounds() const {
  if (!isTurned()) return {m_minimum, m_maximum};
  const Vector3 half = 0.5 * (m_axes.cwiseAbs() * size());
  return {middle() - half, middle() + half};
}

void TurnedBox::go(const RigidMove& move) {
  if (!move.turns()) {
    m_minimum += move.shift, m_maximum += move.shift;
    return;
  }
  const Vector3 there = move.of(middle());
  // By right angles too it is turned: one that is not, of the same place, would not know which way it came there.
  m_axes = straightened(move.turn.toRotationMatrix() * m_axes);
  m_rotation = anglesOf(m_axes);
  resize(size(), there);
}

void TurnedBox::resize(const Vector3& size, const Vector3& middle) {
  m_minimum = middle - 0.5 * size;
  m_maximum = middle + 0.5 * size;
}

void TurnedBox::putInto(Region& region) const { region.minimum = m_minimum, region.maximum = m_maximum; }

void TurnedBox::putInto(Sink& sink) const {
  sink.minimum = m_minimum, sink.maximum = m_maximum;
  for (size_t a = 0; a < 3; ++a) {
    const double turn = m_rotation[static_cast<Eigen::Index>(a)];
    if (turn == 0)
      sink.parameters.values.erase(kTurns[a]);
    else
      sink.parameters.values[kTurns[a]] = turn;
  }
}

}  // namespace ps
