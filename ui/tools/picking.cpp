// SPDX-License-Identifier: Apache-2.0
#include "ui/tools/picking.h"

#include "core/scene/scenewall.h"
#include "core/scene/turnedbox.h"
#include "ui/document/pinaddress.h"
#include "ui/render/furniture.h"
#include "ui/tools/aim.h"
#include "ui/tools/surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace ps {
namespace {

// Units of fineness around a line that take hold of it. Walls are thin and pale, and stand around all the rest.
constexpr double kReach = 7, kWallReach = 4;
// Likewise around the box of a probe where there is matter: whoever clicks on a body with a box in it means the body.
constexpr double kReachOnMatter = 3;

bool has(const std::vector<SelectedItem>& items, const SelectedItem& item) {
  return std::find(items.begin(), items.end(), item) != items.end();
}

double distanceOf(const Pointer& pointer, const Lines& lines) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : lines) least = std::min(least, aimDistance(pointer, from, to));
  return least;
}

/// m along the ray to the face of a wall that looks at the viewer; infinite where it is missed.
double depthOf(const Pointer& pointer, const SceneWall& wall, const render::Face& face) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Vector3 normal = wall.normal.normalized();
  const double against = -pointer.ray.direction.dot(normal);
  if (!(against > 0) || face.corners.size() < 3) return kNone;
  const double depth = (pointer.ray.origin - wall.point).dot(normal) / against;
  const Vector3 at = pointer.ray.origin + depth * pointer.ray.direction;
  for (size_t i = 0; i < face.corners.size(); ++i) {
    const Vector3 &a = face.corners[i], &b = face.corners[(i + 1) % face.corners.size()];
    if ((b - a).cross(at - a).dot(normal) < 0) return kNone;
  }
  return depth > 0 ? depth : kNone;
}

/// Floors and lids are drawn as plates, sides as the edges of panes, curved walls as rings and lines.
bool isPlate(const SceneWall& wall) {
  return !faceOf(wall).isCurved() && std::abs(wall.normal.normalized().y()) > render::kLevel;
}

Lines edgesOf(const render::Face& face) {
  Lines lines;
  for (size_t i = 0; i < face.corners.size(); ++i)
    lines.emplace_back(face.corners[i], face.corners[(i + 1) % face.corners.size()]);
  return lines;
}

/// Those by which one sees a wall, and that a section leaves.
Lines drawnLines(const Environment& environment, size_t wall, const std::optional<Section>& section) {
  const bool side = !faceOf(environment.walls[wall]).isCurved() && !isPlate(environment.walls[wall]);
  return side ? render::paneLines(environment, wall, section) : seenLines(environment, wall, section);
}

/// Whether matter stands between the viewer and a place.
bool isHidden(const Pointer& pointer, const Vector3& place) {
  Pointer there = pointer;
  const Vector3 way = place - pointer.ray.origin;
  there.ray.direction = way.normalized();
  const auto matter = matterOn(there);
  return matter && (*matter - pointer.ray.origin).norm() < way.norm();
}

/// The wall whose edge is seen nearest to the aim.
std::optional<Pick> edgeAt(const Environment& environment, const Pointer& pointer) {
  struct Candidate {
    double distance;
    size_t wall;
    Vector3 place;
  };
  std::vector<Candidate> near;
  for (size_t k = 0; k < environment.walls.size(); ++k) {
    if (!canPick(environment.walls[k])) continue;
    for (const auto& [from, to] : drawnLines(environment, k, pointer.section)) {
      const double distance = aimDistance(pointer, from, to);
      if (distance < kWallReach) near.push_back({distance, k, *nearestPlace(pointer, from, to)});
    }
  }
  std::stable_sort(near.begin(), near.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  const auto seen =
      std::find_if_not(near.begin(), near.end(), [&](const Candidate& one) { return isHidden(pointer, one.place); });
  if (seen == near.end()) return std::nullopt;
  return Pick{{OutlineKind::Wall, environment.walls[seen->wall].id}, true};
}

/// The floor or lid whose face is nearest.
std::optional<Pick> plateAt(const Environment& environment, const Pointer& pointer) {
  std::optional<Pick> nearest;
  double depth = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < environment.walls.size(); ++k) {
    const SceneWall& wall = environment.walls[k];
    if (!canPick(wall) || !isPlate(wall)) continue;
    const double there = depthOf(pointer, wall, render::leftOf(environment, k, pointer.section));
    if (there < depth) depth = there, nearest = Pick{{OutlineKind::Wall, wall.id}, false};
  }
  return nearest;
}

std::optional<Pick> wallAt(const Environment& environment, const Pointer& pointer) {
  std::optional<Pick> pick = edgeAt(environment, pointer);
  if (!pick) pick = plateAt(environment, pointer);
  return pick && matterOn(pointer) ? std::nullopt : pick;  // of all particles, and a pointer that hovers asks often
}

}  // namespace

Lines wallLines(const Environment& environment, size_t wall, bool whole) {
  if (faceOf(environment.walls[wall]).isCurved()) return render::roundLines(environment, wall, whole);
  return edgesOf(render::seenFace(environment, wall));
}

Lines seenLines(const Environment& environment, size_t wall, const std::optional<Section>& section) {
  if (faceOf(environment.walls[wall]).isCurved()) return leftOf(wallLines(environment, wall), section);
  return edgesOf(render::leftOf(environment, wall, section));
}

Lines boxLines(const Region& box) {
  const TurnedBox corners(box);
  Lines lines;
  for (int k = 0; k < 8; ++k) {
    for (int bit = 1; bit < 8; bit *= 2) {
      if (!(k & bit)) lines.emplace_back(corners.corner(k), corners.corner(k | bit));
    }
  }
  return lines;
}

std::vector<SelectedItem> shownPins(const Project& project, const std::vector<SelectedItem>& selected) {
  std::vector<SelectedItem> pins;
  for (const Body& body : project.bodies) {
    std::vector<SelectedItem> own;
    for (size_t k = 0; k < body.pins.size(); ++k) own.push_back({OutlineKind::Pin, PinAddress{body.id, k}.text()});
    const bool shown = has(selected, {OutlineKind::Body, body.id}) ||
                       std::any_of(own.begin(), own.end(), [&](const SelectedItem& pin) { return has(selected, pin); });
    if (shown && body.visible) pins.insert(pins.end(), own.begin(), own.end());
  }
  return pins;
}

std::optional<Pick> pickAt(const Project& project, const std::vector<SelectedItem>& selected, const Pointer& pointer) {
  std::optional<Pick> found;
  double least = kReach;
  const auto look = [&](const SelectedItem& item, const Region& box) {
    const double near = distanceOf(pointer, boxLines(box));
    if (near < least) least = near, found = Pick{item, true};
  };
  for (const SelectedItem& pin : shownPins(project, selected)) look(pin, *findPin(project, pin.id));
  if (found) return found;
  for (const Probe& probe : project.probes) {
    if (canPick(probe) && probe.region) look({OutlineKind::Probe, probe.id}, *probe.region);
  }
  if (found && (least < kReachOnMatter || !matterOn(pointer))) return found;
  return wallAt(project.environment, pointer);
}

}  // namespace ps
