// SPDX-License-Identifier: Apache-2.0
#include "ui/session/excerpt.h"

#include "core/io/projectio.h"
#include "core/scene/group.h"
#include "core/scene/track.h"

#include <algorithm>
#include <set>
#include <utility>

namespace ps {
namespace {

template <class Item>
void take(const std::vector<Item>& all, const std::string& id, std::vector<Item>& to) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Item& item) { return item.id == id; });
  if (found != all.end()) to.push_back(*found);
}

template <class Item>
bool has(const std::vector<Item>& all, const std::string& id) {
  return std::any_of(all.begin(), all.end(), [&](const Item& item) { return item.id == id; });
}

std::set<std::string> materialsOf(const Project& things) {
  std::set<std::string> ids;
  for (const Body& body : things.bodies) {
    ids.insert(body.material);
    const auto* voxels = std::get_if<VoxelShape>(&body.shape);
    for (size_t k = 0; voxels && k < voxels->palette.size(); ++k) ids.insert(voxels->palette[k].material);
  }
  for (const Emitter& emitter : things.emitters) ids.insert(emitter.material);
  return ids;
}

/// Groups and tracks of what was taken; tracks of the scene itself, of its air or its solver, are no thing's.
void takeWhatBelongs(const Project& from, Project& excerpt) {
  excerpt.groups = from.groups;
  excerpt.groups = livingGroups(excerpt);
  excerpt.tracks = from.tracks;
  excerpt.tracks = ownedTracks(excerpt);
  std::erase_if(excerpt.tracks,
                [](const Track& track) { return TrackTarget::parse(track.parameter)->address.id.empty(); });
}

}  // namespace

Project excerptOf(const Project& project, const std::vector<SelectedItem>& items) {
  Project excerpt;
  // Read alone they are judged by the room that they are of, and by its particles.
  excerpt.environment.boundsMinimum = project.environment.boundsMinimum;
  excerpt.environment.boundsMaximum = project.environment.boundsMaximum;
  excerpt.solver.parameters = project.solver.parameters;
  excerpt.environment.walls.clear();
  for (const SelectedItem& item : items) {
    if (item.kind == OutlineKind::Body) take(project.bodies, item.id, excerpt.bodies);
    if (item.kind == OutlineKind::Emitter) take(project.emitters, item.id, excerpt.emitters);
    if (item.kind == OutlineKind::Sink) take(project.sinks, item.id, excerpt.sinks);
    if (item.kind == OutlineKind::Wall) take(project.environment.walls, item.id, excerpt.environment.walls);
    if (item.kind == OutlineKind::Probe) take(project.probes, item.id, excerpt.probes);
  }
  const std::set<std::string> used = materialsOf(excerpt);
  for (const SceneMaterial& material : project.materials) {
    if (used.count(material.id) > 0) excerpt.materials.push_back(material);
  }
  takeWhatBelongs(project, excerpt);
  return excerpt;
}

Project excerptOfMaterials(const Project& project, const std::vector<std::string>& materials) {
  Project excerpt;
  for (const std::string& material : materials) take(project.materials, material, excerpt.materials);
  takeWhatBelongs(project, excerpt);
  return excerpt;
}

bool isEmpty(const Project& excerpt) {
  return excerpt.materials.empty() && excerpt.sinks.empty() && excerpt.environment.walls.empty() &&
         excerpt.probes.empty();
}

std::string textOf(Project excerpt) {
  excerpt.title = "Clipboard";
  // What a probe measures and is not copied with it, nobody can know elsewhere: it then measures all matter.
  for (Probe& probe : excerpt.probes) {
    if (!has(excerpt.bodies, probe.body) && !has(excerpt.emitters, probe.body)) probe.body.clear();
    if (!has(excerpt.environment.walls, probe.wall)) probe.wall.clear();
    if (!has(excerpt.materials, probe.material)) probe.material.clear();
  }
  return writeProject(excerpt);
}

Project excerptIn(const std::string& text, const PluginRegistry& plugins) {
  return readProject(text, "clipboard", plugins).project;
}

std::vector<SelectedItem> itemsOf(const Placement& things) {
  std::vector<SelectedItem> items;
  for (const Probe& probe : things.probes) items.push_back({OutlineKind::Probe, probe.id});
  for (const SceneWall& wall : things.walls) items.push_back({OutlineKind::Wall, wall.id});
  for (const Sink& sink : things.sinks) items.push_back({OutlineKind::Sink, sink.id});
  for (const Emitter& emitter : things.emitters) items.push_back({OutlineKind::Emitter, emitter.id});
  for (const Body& body : things.bodies) items.push_back({OutlineKind::Body, body.id});
  return items;
}

Placement thingsOf(const Project& excerpt) {
  return {excerpt.bodies, excerpt.emitters, excerpt.sinks, excerpt.environment.walls, excerpt.probes};
}

}  // namespace ps
