// SPDX-License-Identifier: Apache-2.0
// Things that come into a document together, as copies or from another project; the order in which things stand, and
// their groups.
#include "core/scene/group.h"
#include "ui/document/commands.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"

#include <algorithm>
#include <map>

namespace ps {
namespace {

using Names = std::map<std::string, std::string>;  ///< ids here, by those that things come with

bool has(const auto& items, const std::string& id) {
  return std::any_of(items.begin(), items.end(), [&](const auto& item) { return item.id == id; });
}

std::string freeId(const auto& items, const std::string& stem) {
  std::string id = stem;
  for (int n = 2; has(items, id); ++n) id = stem + "-" + std::to_string(n);
  return id;
}

bool sameMatter(const SceneMaterial& a, const SceneMaterial& b) {
  return a.base == b.base && a.properties == b.properties && a.parameters == b.parameters && a.adheresTo == b.adheresTo;
}

void follow(const Names& names, std::string& id) {
  if (const auto found = names.find(id); found != names.end()) id = found->second;
}

/// Rows in the order of `ids`; what those do not name comes last.
void sortBy(const std::vector<std::string>& ids, auto& items) {
  const auto rank = [&](const auto& item) { return std::find(ids.begin(), ids.end(), item.id) - ids.begin(); };
  std::stable_sort(items.begin(), items.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
}

std::vector<std::string> idsOf(const auto& items) {
  std::vector<std::string> ids;
  for (const auto& item : items) ids.push_back(item.id);
  return ids;
}

/// The scene's materials with those that come; `names` says what they are called here. The same matter is not had
/// twice.
std::vector<SceneMaterial> withMaterials(const std::vector<SceneMaterial>& here,
                                         const std::vector<SceneMaterial>& coming, Names& names) {
  std::vector<SceneMaterial> all = here;
  for (SceneMaterial material : coming) {
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const SceneMaterial& m) { return sameMatter(m, material); });
    if (same == all.end()) {
      const std::string id = freeId(all, material.id);
      names[material.id] = id;
      material.id = id;
      all.push_back(std::move(material));
    } else {
      names[material.id] = same->id;
    }
  }
  for (size_t k = here.size(); k < all.size(); ++k) {
    if (!all[k].adheresTo) continue;
    for (std::string& partner : *all[k].adheresTo) follow(names, partner);
  }
  return all;
}

}  // namespace

Placement Document::insertThings(Project things, const QString& title) {
  Names materials, owners, walls;
  Placement come;
  std::vector<SceneMaterial> all = withMaterials(m_project.materials, things.materials, materials);
  const bool any = all.size() > m_project.materials.size() || !things.bodies.empty() || !things.emitters.empty() ||
                   !things.sinks.empty() || !things.environment.walls.empty() || !things.probes.empty();
  if (!any) return come;
  m_undo.beginMacro(title);
  if (all.size() > m_project.materials.size())
    m_undo.push(new MaterialsCommand(*this, m_project.materials, std::move(all), title));
  for (Body& body : things.bodies) {
    follow(materials, body.material);
    if (auto* voxels = std::get_if<VoxelShape>(&body.shape)) {
      for (VoxelShape::Paint& paint : voxels->palette) follow(materials, paint.material);
    }
    const std::string old = body.id;
    owners[old] = addBody(std::move(body));
    come.bodies.push_back(*this->body(owners[old]));
  }
  for (Emitter& emitter : things.emitters) {
    follow(materials, emitter.material);
    const std::string old = emitter.id;
    owners[old] = addEmitter(std::move(emitter)).id;
    come.emitters.push_back(*this->emitter(owners[old]));
  }
  for (Sink& sink : things.sinks) come.sinks.push_back(*this->sink(addSink(std::move(sink)).id));
  std::vector<SceneWall> standing = m_project.environment.walls;
  for (SceneWall& wall : things.environment.walls) {
    const std::string old = wall.id;
    wall.id = walls[old] = freeId(standing, old);
    standing.push_back(wall);
    come.walls.push_back(std::move(wall));
  }
  if (!come.walls.empty())
    m_undo.push(new WallsCommand(*this, m_project.environment.walls, std::move(standing), title));
  for (Probe& probe : things.probes) {
    follow(owners, probe.body);
    follow(walls, probe.wall);
    follow(materials, probe.material);
    come.probes.push_back(*this->probe(addProbe(std::move(probe))));
  }
  m_undo.endMacro();
  return come;
}

SceneOrder Document::order() const {
  return {livingGroups(m_project),
          idsOf(m_project.bodies),
          idsOf(m_project.emitters),
          idsOf(m_project.sinks),
          idsOf(m_project.environment.walls),
          idsOf(m_project.probes)};
}

void Document::setOrder(SceneOrder after, const QString& title) {
  SceneOrder before = order();
  before.groups = m_project.groups;  // with those that are out of the scene, which may come back into them
  m_undo.push(new OrderCommand(*this, std::move(before), std::move(after), title));
}

std::string Document::addGroup(std::vector<std::string> members) {
  SceneOrder after = order();
  for (SceneGroup& group : after.groups)
    std::erase_if(group.members, [&](const std::string& member) {
      return std::find(members.begin(), members.end(), member) != members.end();
    });
  std::erase_if(after.groups, [](const SceneGroup& group) { return group.members.empty(); });
  SceneGroup group;
  group.id = freeId(m_project.groups, "group");
  group.name = "G" + group.id.substr(1);
  std::replace(group.name.begin(), group.name.end(), '-', ' ');
  group.members = std::move(members);
  const std::string id = group.id;
  after.groups.push_back(std::move(group));
  setOrder(std::move(after), QStringLiteral("grouping"));
  return id;
}

void Document::removeGroups(const std::vector<std::string>& ids) {
  SceneOrder after = order();
  std::erase_if(after.groups,
                [&](const SceneGroup& group) { return std::find(ids.begin(), ids.end(), group.id) != ids.end(); });
  setOrder(std::move(after), QStringLiteral("ungrouping"));
}

void Document::renameGroup(const std::string& id, const QString& name) {
  SceneOrder after = order();
  const std::string wanted = name.trimmed().toStdString();
  for (SceneGroup& group : after.groups) {
    if (group.id != id || wanted.empty()) continue;
    const QString title = QStringLiteral("rename of %1").arg(QString::fromStdString(group.name));
    group.name = wanted;
    setOrder(std::move(after), title);
    return;
  }
}

void Document::applyOrder(const SceneOrder& order) {
  m_project.groups = order.groups;
  sortBy(order.bodies, m_project.bodies);
  sortBy(order.emitters, m_project.emitters);
  sortBy(order.sinks, m_project.sinks);
  sortBy(order.walls, m_project.environment.walls);
  sortBy(order.probes, m_project.probes);
  ++m_changes;
  notify(OrderChanged{});
}

}  // namespace ps
