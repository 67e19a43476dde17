// SPDX-License-Identifier: Apache-2.0
// Rigid bodies that contact could not keep within the walls.
#include "core/solver/contact/membersums.h"
#include "core/solver/contact/rigidcontact.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// How far a body may sink into a wall, in spacings. In a corner each pass goes half of what is left; a body that two
/// walls are too narrow for ends up in the middle.
constexpr double kDeepest = 0.5;
constexpr int kInwardPasses = 8;

}  // namespace

/// m, how far a body would be behind a wall if its members were at `points`, and the way out of it there.
RigidContact::Deepest RigidContact::depthOf(const WallFace& wall, const Body& body, const api::Float4* points) {
  return sumOver<Deepest>(body.members, [&](Deepest& deepest, uint32_t i) {
    const Vector3 place = vectorOf(points[i]);
    const double depth = -wall.heightOf(place);
    if (depth > deepest.depth) deepest = {depth, wall.at(place).normal};
  });
}

RigidContact::Box RigidContact::boxOf(const Body& body, const api::Float4* points) {
  struct Extent {
    api::Float4 low{HUGE_VALF, HUGE_VALF, HUGE_VALF, 0}, high{-HUGE_VALF, -HUGE_VALF, -HUGE_VALF, 0};
    void operator+=(const Extent& other) {
      low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y), std::min(low.z, other.low.z), 0};
      high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y), std::max(high.z, other.high.z), 0};
    }
  };
  const Extent extent = sumOver<Extent>(body.members, [&](Extent& some, uint32_t i) {
    some += Extent{points[i], points[i]};
  });
  return {vectorOf(extent.low), vectorOf(extent.high)};
}

/// Whether nothing in a box is behind a wall by more than `depth` m.
bool RigidContact::isClear(const WallFace& wall, const Box& box, double depth) {
  if (wall.isCurved()) return wall.heightOf(0.5 * (box.low + box.high)) - 0.5 * (box.high - box.low).norm() >= -depth;
  const Plane& plane = wall.plane();
  const Vector3 nearest = (plane.normal.array() > 0).select(box.low, box.high);
  return plane.heightOf(nearest) >= -depth;
}

Vector3 RigidContact::keepInside(ParticleStore& store) const {
  const double most = kDeepest * m_spacing;
  Vector3 moved;
  for (const Body& body : m_bodies) {
    if (!body.hasContacts) continue;
    const Box box = boxOf(body, store.position());
    if (std::all_of(m_walls.begin(), m_walls.end(), [&](const WallFace& wall) { return isClear(wall, box, most); }))
      continue;
    int walls = 0;
    for (int pass = 0; pass < kInwardPasses; ++pass) {
      Vector3 way;
      walls = 0;
      uint32_t by = 0;
      for (uint32_t w = 0; w < m_walls.size(); ++w) {
        const Deepest deepest = depthOf(m_walls[w], body, store.position());
        if (!(deepest.depth > most)) continue;
        way += (deepest.depth - most) * deepest.normal;
        by = w;
        ++walls;
      }
      if (walls == 0) break;
      const Vector3 given = shift(store, body, 1.0 / walls * way);
      moved += given;
      m_reactions->add(m_reactions->ofWall(by), body.centre, -m_reactions->perStep() * given);
    }
    if (walls > 1) moved += takeBack(store, body);
  }
  return moved;
}

/// A turn that walls leave no room for does not take place: the body stays where it was, unless that was worse.
Vector3 RigidContact::takeBack(ParticleStore& store, const Body& body) const {
  double now = 0, before = 0;
  for (const WallFace& wall : m_walls) {
    now = std::max(now, depthOf(wall, body, store.position()).depth);
    before = std::max(before, depthOf(wall, body, store.previous()).depth);
  }
  Vector3 moved;
  if (now <= before || now < kDeepest * m_spacing + kCreep * m_spacing) return moved;
  for (const uint32_t i : body.members) {
    api::Float4& x = store.position()[i];
    const api::Float4& from = store.previous()[i];
    moved += double{store.mass()[i]} * (vectorOf(from) - vectorOf(x));
    x.x = from.x, x.y = from.y, x.z = from.z;
  }
  return moved;
}

}  // namespace ps
