// SPDX-License-Identifier: Apache-2.0
#include "frame.h"

#include "stamping.h"
#include "turned.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ps::brushes {
namespace {

constexpr double kMostPieces = 1e5;  // of the way between two samples, which lie a spacing apart

Double3 between(const Double3& a, const Double3& b, double t) { return sum(scaled(a, 1 - t), scaled(b, t)); }

/// From one unit vector to another in equal steps of the angle between them, rad (Shoemake 1985). Straight on and
/// straight back there is no bend: the second.
Double3 turning(const Double3& a, const Double3& b, double angle, double t) {
  constexpr double kStraight = 1e-6;
  const double sine = std::sin(angle);
  if (!(sine > kStraight)) return b;
  return sum(scaled(a, std::sin((1 - t) * angle) / sine), scaled(b, std::sin(t * angle) / sine));
}

}  // namespace

Frame frameOf(const api::StrokeContext& context, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {context.up, sum(scaled(context.side, c), scaled(context.front, s)),
          sum(scaled(context.side, -s), scaled(context.front, c))};
}

Double3 alongFrame(const api::StrokeContext& context, const Double3& v, double tip, double angle) {
  const double side = dot(v, context.side), up = dot(v, context.up), front = dot(v, context.front);
  const double c = std::cos(tip), s = std::sin(tip);
  const Frame frame = frameOf(context, angle);
  return sum(scaled(frame.side, side),
             sum(scaled(frame.up, c * up - s * front), scaled(frame.front, s * up + c * front)));
}

Double3 following(const Double3& turn, const Double3& up, double how) {
  const double angle = norm(turn);
  if (how == kFollowsNothing || angle == 0) return {0, 0, 0};
  if (how != kFollowsRotation) return turn;
  // The twist about up, of swing and twist (Dobrowolski 2015).
  const double along = std::sin(angle / 2) / angle * dot(turn, up);
  return scaled(up, 2 * std::atan2(along, std::cos(angle / 2)));
}

Double3 turned(const Double3& v, const Double3& turn) {
  const double angle = norm(turn);
  if (angle == 0) return v;
  const Double3 n = scaled(turn, 1 / angle);
  const double c = std::cos(angle), s = std::sin(angle);  // Rodrigues 1840
  return sum(sum(scaled(v, c), scaled(cross(n, v), s)), scaled(n, dot(n, v) * (1 - c)));
}

Frame held(const Frame& frame, const Double3& turn, double how) {
  const Double3 followed = following(turn, frame.up, how);
  return {turned(frame.up, followed), turned(frame.side, followed), turned(frame.front, followed)};
}

Double3 extentOf(const Frame& frame, const Double3& half) {
  const auto along = [&](double Double3::*axis) {
    return std::abs(frame.up.*axis) * half.x + std::abs(frame.side.*axis) * half.y +
           std::abs(frame.front.*axis) * half.z;
  };
  return {along(&Double3::x), along(&Double3::y), along(&Double3::z)};
}

void alongWay(const api::StrokeContext& context, const api::List<api::StrokeSample>& samples, double reach,
              const Borrowed<void(const Section&)>& each) {
  if (samples.count == 0) return;
  api::StrokeSample last = samples.at(0);
  if (samples.count == 1) return each({last.position, last.direction, last.pressure, last.turn});
  for (size_t s = 1; s < samples.count; ++s) {
    const api::StrokeSample next = samples.at(s);
    const bool begins = dot(last.direction, last.direction) == 0;
    const Double3 from = begins ? next.direction : last.direction;
    const double turn = std::acos(std::clamp(dot(from, next.direction), -1.0, 1.0));
    const double way = std::max(norm(difference(next.position, last.position)), turn * reach);
    const double pieces = std::ceil(way / (0.5 * context.spacing));
    if (!(pieces < kMostPieces)) throw std::length_error("the brush is too large for the spacing of the particles");
    for (double k = begins ? 0 : 1; k <= pieces; ++k) {
      const double t = pieces > 0 ? k / pieces : 1;
      each({between(last.position, next.position, t), turning(from, next.direction, turn, t),
            std::lerp(last.pressure, next.pressure, t), next.turn});
    }
    last = next;
  }
}

}  // namespace ps::brushes
