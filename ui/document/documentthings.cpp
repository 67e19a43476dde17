// SPDX-License-Identifier: Apache-2.0
// Things that come into a document together, as copies or from another project; the order in which things stand, and
// their groups.
#include "core/scene/group.h"
#include "core/scene/track.h"
#include "ui/document/commands.h"
#include "ui/document/declared.h"
#include "ui/document/document.h"
#include "ui/document/freename.h"

#include <algorithm>
#include <map>
#include <set>

namespace ps {
namespace {

using Names = std::map<std::string, std::string>;  ///< ids here, by those that things come with
struct AllNames {
  Names materials, owners, sinks, walls, probes;  ///< owners: bodies and emitters
  const Names* of(Owner owner) const {
    switch (owner) {
      case Owner::Material:
        return &materials;
      case Owner::Body:
      case Owner::Shape:
      case Owner::Constraint:
      case Owner::Emitter:
        return &owners;
      case Owner::Sink:
        return &sinks;
      case Owner::Wall:
        return &walls;
      case Owner::Probe:
        return &probes;
      default:
        return nullptr;
    }
  }
};

bool has(const auto& items, const std::string& id) {
  return std::any_of(items.begin(), items.end(), [&](const auto& item) { return item.id == id; });
}

std::string freeId(const auto& items, const std::string& stem) {
  std::string id = stem;
  for (int n = 2; has(items, id); ++n) id = stem + "-" + std::to_string(n);
  return id;
}

/// The keys of a material, by what they are of.
std::map<std::string, std::vector<TrackKey>> keysOf(const Project& project, const std::string& material) {
  const std::string prefix = Address{Owner::Material, material, ""}.prefix();
  std::map<std::string, std::vector<TrackKey>> keys;
  for (const Track& track : project.tracks) {
    if (track.parameter.starts_with(prefix)) keys[track.parameter.substr(prefix.size())] = track.keys;
  }
  return keys;
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

/// The scene's materials with those that come; `names` says what they are called here. The same matter, which changes
/// over time alike, is not had twice.
std::vector<SceneMaterial> withMaterials(const Project& here, const Project& coming, Names& names) {
  std::vector<SceneMaterial> all = here.materials;
  for (SceneMaterial material : coming.materials) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const SceneMaterial& m) {
      return sameMatter(m, material) && keysOf(here, m.id) == keysOf(coming, material.id);
    });
    if (same == all.end()) {
      const std::string id = freeId(all, material.id);
      names[material.id] = id;
      material.id = id;
      all.push_back(std::move(material));
    } else {
      names[material.id] = same->id;
    }
  }
  for (size_t k = here.materials.size(); k < all.size(); ++k) {
    if (!all[k].adheresTo) continue;
    for (std::string& partner : *all[k].adheresTo) follow(names, partner);
  }
  return all;
}

/// Tracks that come, as edits of those that are there: one may wait there for a wall of the same id.
std::vector<TrackEdit> arrivingTracks(const std::vector<Track>& here, const std::vector<Track>& coming,
                                      const AllNames& names) {
  std::vector<TrackEdit> edits;
  size_t count = here.size();
  for (Track track : coming) {
    auto target = TrackTarget::parse(track.parameter);
    const Names* ids = target ? names.of(target->address.owner) : nullptr;
    const auto id = ids ? ids->find(target->address.id) : Names::const_iterator();
    if (!ids || id == ids->end()) continue;
    target->address.id = id->second;
    track.parameter = target->address.text();
    if (target->point) track.parameter += '[' + std::to_string(*target->point) + ']';
    const Track* old = findTrack(here, track.parameter);
    if (old && old->keys == track.keys) continue;
    TrackEdit edit{old ? static_cast<size_t>(old - here.data()) : count++, std::nullopt, std::move(track)};
    if (old) edit.before = *old;
    edits.push_back(std::move(edit));
  }
  return edits;
}

/// A member of a group as it is called here; "" where it has not come.
std::string memberHere(const std::string& member, const AllNames& names) {
  for (const Owner owner : kMembers) {
    const std::string prefix = memberOf(owner, "");
    const Names& ids = *names.of(owner);
    const auto id = member.starts_with(prefix) ? ids.find(member.substr(prefix.size())) : ids.end();
    if (id != ids.end()) return memberOf(owner, id->second);
  }
  return {};
}

bool hasMember(const SceneGroup& group, const std::string& member) {
  return std::find(group.members.begin(), group.members.end(), member) != group.members.end();
}

/// Whether a group that comes was copied from this one, which has more: `known` says whom it has had, though they may
/// be out of the scene by now.
bool isPartOf(const SceneGroup& coming, const SceneGroup& living, const std::vector<SceneGroup>& known) {
  if (coming.id != living.id || coming.name != living.name) return false;
  const auto raw = std::find_if(known.begin(), known.end(), [&](const SceneGroup& g) { return g.id == living.id; });
  const auto both = [&](const std::string& member) { return raw != known.end() && hasMember(*raw, member); };
  return std::any_of(coming.members.begin(), coming.members.end(), both) &&
         std::any_of(living.members.begin(), living.members.end(),
                     [&](const std::string& member) { return !hasMember(coming, member); });
}

/// The scene's groups with those that come.
std::vector<SceneGroup> withGroups(const Project& here, const std::vector<SceneGroup>& before,
                                   const std::vector<SceneGroup>& coming, const AllNames& names) {
  std::vector<SceneGroup> all = before, known = here.groups;
  std::set<std::string> taken;
  for (const SceneGroup& group : all) taken.insert(group.name);
  for (SceneGroup group : coming) {
    const auto whole =
        std::find_if(all.begin(), all.end(), [&](const SceneGroup& g) { return isPartOf(group, g, here.groups); });
    for (std::string& member : group.members) member = memberHere(member, names);
    std::erase(group.members, std::string());
    if (group.members.empty()) continue;
    if (whole != all.end()) {
      whole->members.insert(whole->members.end(), group.members.begin(), group.members.end());
      continue;
    }
    group.id = freeId(known, group.id);
    group.name = freeName(group.name, taken);
    taken.insert(group.name);
    known.push_back(group);
    all.push_back(std::move(group));
  }
  return all;
}

}  // namespace

Placement Document::insertThings(Project things, const QString& title) {
  AllNames names;
  Placement come;
  std::vector<SceneMaterial> all = withMaterials(m_project, things, names.materials);
  const std::vector<SceneGroup> groups = livingGroups(m_project);
  const bool any = all.size() > m_project.materials.size() || !things.bodies.empty() || !things.emitters.empty() ||
                   !things.sinks.empty() || !things.environment.walls.empty() || !things.probes.empty();
  if (!any) return come;
  m_undo.beginMacro(title);
  if (all.size() > m_project.materials.size())
    m_undo.push(new MaterialsCommand(*this, m_project.materials, std::move(all), title));
  for (Body& body : things.bodies) {
    follow(names.materials, body.material);
    if (auto* voxels = std::get_if<VoxelShape>(&body.shape)) {
      for (VoxelShape::Paint& paint : voxels->palette) follow(names.materials, paint.material);
    }
    const std::string old = body.id;
    names.owners[old] = addBody(std::move(body));
    come.bodies.push_back(*this->body(names.owners[old]));
  }
  for (Emitter& emitter : things.emitters) {
    follow(names.materials, emitter.material);
    const std::string old = emitter.id;
    names.owners[old] = addEmitter(std::move(emitter)).id;
    come.emitters.push_back(*this->emitter(names.owners[old]));
  }
  for (Sink& sink : things.sinks) {
    const std::string old = sink.id;
    names.sinks[old] = addSink(std::move(sink)).id;
    come.sinks.push_back(*this->sink(names.sinks[old]));
  }
  std::vector<SceneWall> standing = m_project.environment.walls;
  for (SceneWall& wall : things.environment.walls) {
    const std::string old = wall.id;
    wall.id = names.walls[old] = freeId(standing, old);
    standing.push_back(wall);
    come.walls.push_back(std::move(wall));
  }
  if (!come.walls.empty())
    m_undo.push(new WallsCommand(*this, m_project.environment.walls, std::move(standing), title));
  for (Probe& probe : things.probes) {
    follow(names.owners, probe.body);
    follow(names.walls, probe.wall);
    follow(names.materials, probe.material);
    const std::string old = probe.id;
    names.probes[old] = addProbe(std::move(probe));
    come.probes.push_back(*this->probe(names.probes[old]));
  }
  if (std::vector<TrackEdit> tracks = arrivingTracks(m_project.tracks, things.tracks, names); !tracks.empty())
    m_undo.push(new TrackCommand(*this, std::move(tracks), ++m_gesture, title));
  SceneOrder after = order();
  after.groups = withGroups(m_project, groups, things.groups, names);
  if (after.groups != groups) setOrder(std::move(after), title);
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
