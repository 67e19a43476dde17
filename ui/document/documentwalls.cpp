// SPDX-License-Identifier: Apache-2.0
// Walls of a document: they come where the scene ends, are renamed, and go.
#include "core/scene/scenewall.h"
#include "ui/document/commands.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/leaving.h"
#include "ui/document/wallside.h"

#include <algorithm>
#include <cmath>

namespace ps {
namespace {

/// Whether a wall looks the same way: it keeps matter from leaving on that side already.
bool stands(const SceneWall& wall, const WallSide& side) {
  return !faceOf(wall).isCurved() && (side.upper ? -1 : 1) * wall.normal[side.axis] > 0.99 * wall.normal.norm();
}

/// "" or why no wall comes on that side.
QString whyNone(const Environment& environment, const WallSide& side) {
  if (environment.periodic[side.axis])
    return QStringLiteral("The scene repeats itself along %1: it has no end there.").arg(QChar("xyz"[side.axis]));
  for (const SceneWall& wall : environment.walls) {
    if (stands(wall, side)) return QStringLiteral("“%1” closes that side already.").arg(nameOf(wall));
  }
  return {};
}

std::string freeId(const std::vector<SceneWall>& walls, const std::string& stem) {
  const auto taken = [&](const std::string& id) {
    return std::any_of(walls.begin(), walls.end(), [&](const SceneWall& wall) { return wall.id == id; });
  };
  std::string id = stem;
  for (int n = 2; taken(id); ++n) id = stem + "-" + std::to_string(n);
  return id;
}

}  // namespace

Room roomOf(const Environment& environment) {
  Room room{environment.boundsMinimum, environment.boundsMaximum};
  for (const SceneWall& wall : environment.walls) {
    for (const WallSide& side : kWallSides) {
      if (!stands(wall, side)) continue;
      double& end = (side.upper ? room.maximum : room.minimum)[side.axis];
      end = side.upper ? std::min(end, wall.point[side.axis]) : std::max(end, wall.point[side.axis]);
    }
  }
  return room;
}

SceneWall wallOn(const WallSide& side, const Vector3& minimum, const Vector3& maximum) {
  SceneWall wall;
  wall.id = side.id;
  wall.name = side.name;
  wall.point.setZero();
  wall.normal.setZero();
  wall.point[side.axis] = (side.upper ? maximum : minimum)[side.axis];
  wall.normal[side.axis] = side.upper ? -1 : 1;
  return wall;
}

SceneWall roundWall(WallForm form, const Project& project) {
  const Room room = roomOf(project.environment);
  const Vector3 size = room.maximum - room.minimum;
  const bool sphere = form == WallForm::Sphere;
  SceneWall wall;
  wall.id = shapeOf(form);
  wall.name = sphere ? "Sphere" : "Cylinder";
  wall.point = 0.5 * (room.minimum + room.maximum);
  wall.parameters.values["shape"] = shapeOf(form);
  const double around = 0.5 * (sphere ? size.norm() : std::hypot(size.x(), size.z()));
  const double within = 0.5 * (sphere ? size.minCoeff() : std::min(size.x(), size.z()));
  wall.parameters.values["radius"] = project.bodies.empty() ? within : around;
  return wall;
}

const SceneWall* Document::wall(const std::string& id) const {
  const std::vector<SceneWall>& walls = m_project.environment.walls;
  const auto found = std::find_if(walls.begin(), walls.end(), [&](const SceneWall& wall) { return wall.id == id; });
  return found == walls.end() ? nullptr : &*found;
}

QString Document::addWalls(const std::vector<std::string>& sides) {
  const Environment& environment = m_project.environment;
  // Just inside the bounds, so that what leans on a wall does not count as lost.
  const double inset = 2 * numberOf(m_project.solver.parameters, solverParameters(), "particle_spacing");
  Vector3 minimum = environment.boundsMinimum, maximum = environment.boundsMaximum;
  for (size_t a = 0; a < 3; ++a) minimum[a] += inset, maximum[a] -= inset;
  std::vector<SceneWall> walls = environment.walls;
  QString problem;
  for (const WallSide& side : kWallSides) {
    if (std::find(sides.begin(), sides.end(), side.id) == sides.end()) continue;
    if (const QString why = whyNone(environment, side); !why.isEmpty()) {
      problem = why;
      continue;
    }
    walls.push_back(wallOn(side, minimum, maximum));
    walls.back().id = freeId(environment.walls, side.id);
  }
  const size_t added = walls.size() - environment.walls.size();
  if (added == 0) return problem;
  const QString title =
      added == 1 ? QStringLiteral("adding %1").arg(nameOf(walls.back())) : QStringLiteral("adding walls");
  m_undo.push(new WallsCommand(*this, environment.walls, std::move(walls), title));
  return {};
}

void Document::removeWall(const std::string& id) {
  const SceneWall* old = wall(id);
  if (!old) return;
  std::vector<SceneWall> walls = m_project.environment.walls;
  walls.erase(walls.begin() + (old - m_project.environment.walls.data()));
  const QString title = QStringLiteral("deletion of %1").arg(nameOf(*old));
  takeOut(*this, {Owner::Wall, id, ""}, title,
          [&] { m_undo.push(new WallsCommand(*this, m_project.environment.walls, std::move(walls), title)); });
}

void Document::renameWall(const std::string& id, const QString& name) {
  const SceneWall* old = wall(id);
  const std::string wanted = name.trimmed().toStdString();
  if (!old || wanted.empty() || wanted == old->name) return;
  std::vector<SceneWall> walls = m_project.environment.walls;
  walls[static_cast<size_t>(old - m_project.environment.walls.data())].name = wanted;
  m_undo.push(new WallsCommand(*this, m_project.environment.walls, std::move(walls),
                               QStringLiteral("rename of %1").arg(nameOf(*old))));
}

void Document::applyWalls(const std::vector<SceneWall>& walls) {
  m_project.environment.walls = walls;
  ++m_changes;
  notify(WallsChanged{});
}

}  // namespace ps
