// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/arrange.h"

#include "core/scene/turnedbox.h"
#include "ui/document/wallside.h"
#include "ui/render/framing.h"
#include "ui/tools/placing.h"
#include "ui/tools/surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace ps {
namespace {

constexpr int kMostSteps = 12;      // along one axis, of the things' own size
constexpr double kTouching = 1e-6;  // m, by which boxes that touch may overlap

BodyBounds boxOf(const Body& body, const MatterBoxes& matter) {
  const auto known = matter.find(body.id);
  return known == matter.end() ? boundsOf(body) : known->second;
}
BodyBounds boxOf(const Emitter& emitter, const MatterBoxes&) {
  const Vector3 half = Vector3::Constant(numberOf(emitter.parameters, emitterParameters(), "diameter") / 2);
  return {emitter.point - half, emitter.point + half};
}
template <class Box>
BodyBounds boxOf(const Box& box, const MatterBoxes&) {
  return TurnedBox(box).bounds();
}

/// visit(thing's box, a placement of it alone) for each that has an extent.
template <class Visit>
void eachBox(const Placement& things, const MatterBoxes& matter, Visit&& visit) {
  for (const Body& body : things.bodies) visit(boxOf(body, matter), Placement{{body}, {}, {}, {}, {}});
  for (const Emitter& emitter : things.emitters) visit(boxOf(emitter, matter), Placement{{}, {emitter}, {}, {}, {}});
  for (const Sink& sink : things.sinks) visit(boxOf(sink, matter), Placement{{}, {}, {sink}, {}, {}});
  for (const Probe& probe : things.probes) {
    if (probe.region) visit(boxOf(*probe.region, matter), Placement{{}, {}, {}, {}, {probe}});
  }
  for (const BodyPins& pins : things.pins) {
    for (const size_t k : pins.chosen)
      visit(boxOf(pins.boxes[k], matter), Placement{{}, {}, {}, {}, {}, {{pins.id, pins.boxes, {k}}}});
  }
}

/// Pins of a body that were put elsewhere one by one are so together.
void append(std::vector<BodyPins>& to, const BodyPins& more) {
  const auto own = std::find_if(to.begin(), to.end(), [&](const BodyPins& pins) { return pins.id == more.id; });
  if (own == to.end()) return to.push_back(more);
  for (const size_t k : more.chosen) {
    own->boxes[k] = more.boxes[k];
    own->chosen.push_back(k);
  }
}

void append(Placement& to, const Placement& more) {
  to.bodies.insert(to.bodies.end(), more.bodies.begin(), more.bodies.end());
  to.emitters.insert(to.emitters.end(), more.emitters.begin(), more.emitters.end());
  to.sinks.insert(to.sinks.end(), more.sinks.begin(), more.sinks.end());
  to.walls.insert(to.walls.end(), more.walls.begin(), more.walls.end());
  to.probes.insert(to.probes.end(), more.probes.begin(), more.probes.end());
  for (const BodyPins& pins : more.pins) append(to.pins, pins);
}

struct Boxed {
  BodyBounds box;
  Placement thing;
};
std::vector<Boxed> boxed(const Placement& things, const MatterBoxes& matter) {
  std::vector<Boxed> list;
  eachBox(things, matter, [&](const BodyBounds& box, Placement thing) { list.push_back({box, std::move(thing)}); });
  return list;
}
/// Walls too, which are a point each.
std::vector<Boxed> placed(const Placement& things, const MatterBoxes& matter) {
  std::vector<Boxed> list = boxed(things, matter);
  for (const SceneWall& wall : things.walls)
    list.push_back({{wall.point, wall.point}, Placement{{}, {}, {}, {wall}, {}}});
  return list;
}

double at(const BodyBounds& box, int axis, Side side) {
  return side == Side::Least ? box.minimum[axis] : side == Side::Greatest ? box.maximum[axis] : box.middle()[axis];
}

bool overlap(const BodyBounds& a, const BodyBounds& b, int axis) {
  return a.minimum[axis] < b.maximum[axis] - kTouching && b.minimum[axis] < a.maximum[axis] - kTouching;
}
bool overlap(const BodyBounds& a, const BodyBounds& b) {
  return overlap(a, b, 0) && overlap(a, b, 1) && overlap(a, b, 2);
}

/// Bodies where they are made and where their matter is, taps and drains.
std::vector<BodyBounds> obstaclesOf(const Project& project, const MatterBoxes& matter) {
  std::vector<BodyBounds> boxes;
  const Placement all{project.bodies, project.emitters, project.sinks, {}, {}};
  for (const MatterBoxes& by : {MatterBoxes{}, matter})
    eachBox(all, by, [&](const BodyBounds& box, const Placement&) { boxes.push_back(box); });
  return boxes;
}

/// m, to which ways are rounded up: cells of sketches.
double gridOf(const Placement& things) {
  double grid = 0;
  for (const Body& body : things.bodies) {
    if (const auto* voxels = std::get_if<VoxelShape>(&body.shape)) grid = std::max(grid, voxels->spacing);
  }
  return grid;
}

}  // namespace

MatterBoxes matterBoxesOf(const Snapshot* scene) {
  MatterBoxes boxes;
  if (!scene || !scene->bodyIds) return boxes;
  const std::vector<std::optional<Box>> all = boxesOfBodies(*scene);
  for (size_t k = 0; k < all.size(); ++k) {
    if (all[k]) boxes[(*scene->bodyIds)[k]] = {all[k]->first, all[k]->second};
  }
  return boxes;
}

std::optional<BodyBounds> boundsOf(const Placement& things, const MatterBoxes& matter) {
  std::optional<BodyBounds> all;
  eachBox(things, matter, [&](const BodyBounds& box, const Placement&) {
    if (!all) all = box;
    all->minimum = all->minimum.cwiseMin(box.minimum);
    all->maximum = all->maximum.cwiseMax(box.maximum);
  });
  return all;
}

std::optional<Vector3> wayToFreeRoom(const Project& project, const Placement& things, const MatterBoxes& matter) {
  const std::optional<BodyBounds> box = boundsOf(things, {});
  if (!box) return Vector3(Vector3::Zero());
  const Room room = roomOf(project.environment);
  const std::vector<BodyBounds> obstacles = obstaclesOf(project, matter);
  const double spacing = numberOf(project.solver.parameters, solverParameters(), "particle_spacing");
  const double grid = gridOf(things);
  std::vector<Vector3> ways;
  for (const auto& [axis, sign] : {std::pair(0, 1), {0, -1}, {2, 1}, {2, -1}, {1, 1}}) {
    double step = box->size()[axis] + spacing;
    if (grid > 0) step = grid * std::ceil(step / grid - kTouching);
    for (int n = 1; n <= kMostSteps; ++n) {
      Vector3 way;
      way[axis] = sign * n * step;
      ways.push_back(way);
    }
  }
  std::stable_sort(ways.begin(), ways.end(),
                   [](const Vector3& a, const Vector3& b) { return a.squaredNorm() < b.squaredNorm() - kTouching; });
  for (const Vector3& way : ways) {
    const BodyBounds there{box->minimum + way, box->maximum + way};
    const bool inside = (there.minimum.array() >= room.minimum.array() - kTouching).all() &&
                        (there.maximum.array() <= room.maximum.array() + kTouching).all();
    if (inside && std::none_of(obstacles.begin(), obstacles.end(),
                               [&](const BodyBounds& other) { return overlap(there, other); }))
      return way;
  }
  return std::nullopt;
}

bool overlapsAny(const Project& project, const Placement& things, const MatterBoxes& matter) {
  bool any = false;
  const std::vector<BodyBounds> obstacles = obstaclesOf(project, matter);
  eachBox(things, {}, [&](const BodyBounds& box, const Placement&) {
    for (const BodyBounds& other : obstacles) any = any || overlap(box, other);
  });
  return any;
}

std::vector<BodyBounds> bodiesBeside(const Project& project, const Placement& things, const MatterBoxes& matter) {
  std::vector<BodyBounds> boxes;
  for (const Body& body : project.bodies) {
    const bool same =
        std::any_of(things.bodies.begin(), things.bodies.end(), [&](const Body& other) { return other.id == body.id; });
    if (!same) boxes.push_back(boxOf(body, matter));
  }
  return boxes;
}

double heightUnder(const BodyBounds& box, const std::vector<BodyBounds>& bodies, double floor) {
  double height = floor;
  for (const BodyBounds& other : bodies) {
    if (overlap(box, other, 0) && overlap(box, other, 2)) height = std::max(height, other.maximum.y());
  }
  return height;
}

Placement aligned(Placement things, const MatterBoxes& matter, int axis, Side side) {
  const std::vector<Boxed> row = placed(things, matter);
  Placement out;
  if (row.empty()) return out;
  BodyBounds all = row.front().box;
  for (const Boxed& one : row) all = {all.minimum.cwiseMin(one.box.minimum), all.maximum.cwiseMax(one.box.maximum)};
  for (const Boxed& one : row) {
    Vector3 way;
    way[axis] = at(all, axis, side) - at(one.box, axis, side);
    append(out, shifted(one.thing, way));
  }
  return out;
}

Placement distributed(Placement things, const MatterBoxes& matter, int axis) {
  std::vector<Boxed> row = placed(things, matter);
  std::stable_sort(row.begin(), row.end(),
                   [&](const Boxed& a, const Boxed& b) { return a.box.middle()[axis] < b.box.middle()[axis]; });
  Placement out;
  if (row.size() < 3) return out;
  double filled = 0;
  for (const Boxed& one : row) filled += one.box.size()[axis];
  const double gap =
      (row.back().box.maximum[axis] - row.front().box.minimum[axis] - filled) / static_cast<double>(row.size() - 1);
  double next = row.front().box.minimum[axis];
  for (const Boxed& one : row) {
    Vector3 way;
    way[axis] = next - one.box.minimum[axis];
    next += one.box.size()[axis] + gap;
    append(out, shifted(one.thing, way));
  }
  return out;
}

Placement dropped(const Project& project, Placement things, const MatterBoxes& matter) {
  const double floor = floorHeight(project.environment);
  std::vector<BodyBounds> below = bodiesBeside(project, things, matter);
  // The lowest first: what falls may land on what has fallen.
  std::vector<Boxed> falling = boxed(things, matter);
  std::stable_sort(falling.begin(), falling.end(),
                   [](const Boxed& a, const Boxed& b) { return a.box.minimum.y() < b.box.minimum.y(); });
  Placement out;
  for (Boxed& one : falling) {
    double height = floor;
    for (const BodyBounds& other : below) {
      if (overlap(one.box, other, 0) && overlap(one.box, other, 2) &&
          other.maximum.y() <= one.box.minimum.y() + kTouching)
        height = std::max(height, other.maximum.y());
    }
    const Vector3 way(0, height - one.box.minimum.y(), 0);
    append(out, shifted(one.thing, way));
    if (!one.thing.bodies.empty()) below.push_back({one.box.minimum + way, one.box.maximum + way});
  }
  return out;
}

namespace {

RigidMove moveOf(const Vector3& from, const Vector3& to, const Vector3& direction, const Vector3& now) {
  RigidMove move;
  if (direction != now) move.turn = Quaternion::FromTwoVectors(direction, now);
  move.shift = move.turns() ? Vector3(to - move.turn * from) : Vector3(to - from);
  return move;
}
RigidMove moveOf(const Body& before, const Body& now) {
  return moveBetween(sizedAs(before, now), now).value_or(RigidMove{});
}
RigidMove moveOf(const Emitter& before, const Emitter& now) {
  return moveOf(before.point, now.point, before.direction, now.direction);
}
RigidMove moveOf(const SceneWall& before, const SceneWall& now) {
  return moveOf(before.point, now.point, before.normal, now.normal);
}
template <class Box>
RigidMove moveOfBox(const Box& before, const Box& now) {
  const TurnedBox from(before), to(now);
  RigidMove move;
  if (from.axes() != to.axes()) move.turn = Quaternion(to.axes() * from.axes().transpose()).normalized();
  move.shift = to.middle() - (move.turns() ? Vector3(move.turn * from.middle()) : from.middle());
  return move;
}
RigidMove moveOf(const Sink& before, const Sink& now) { return moveOfBox(before, now); }
RigidMove moveOf(const Probe& before, const Probe& now) {
  return before.region && now.region ? moveOfBox(*before.region, *now.region) : RigidMove{};
}

void go(Body& body, const RigidMove& move) { body = moved(std::move(body), possibleMove(body, move)); }
void go(Emitter& emitter, const RigidMove& move) {
  emitter.point = move.of(emitter.point);
  emitter.direction = move.turn * emitter.direction;
}
void go(SceneWall& wall, const RigidMove& move) {
  wall.point = move.of(wall.point);
  wall.normal = move.turn * wall.normal;
}
void go(Sink& sink, const RigidMove& move) { sink = carried(std::move(sink), move); }
void go(Probe& probe, const RigidMove& move) {
  if (probe.region) *probe.region = carried(std::move(*probe.region), move);
}

/// visit(as it was, as it is) for each.
template <class Visit>
void eachPair(const Placement& before, Placement& now, Visit&& visit) {
  const auto each = [&](const auto& was, auto& is) {
    for (size_t k = 0; k < std::min(was.size(), is.size()); ++k) visit(was[k], is[k]);
  };
  each(before.bodies, now.bodies);
  each(before.emitters, now.emitters);
  each(before.sinks, now.sinks);
  each(before.walls, now.walls);
  each(before.probes, now.probes);
}

}  // namespace

bool standElsewhere(const Placement& before, const Placement& now) {
  bool any = false;
  Placement there = now;
  eachPair(before, there, [&](const auto& was, auto& is) { any = any || !moveOf(was, is).isNothing(); });
  return any;
}

Placement continued(const Placement& before, Placement now) {
  eachPair(before, now, [](const auto& was, auto& is) { go(is, moveOf(was, is)); });
  return now;
}

}  // namespace ps
