// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/scene/project.h"
#include "core/simulation/command.h"
#include "ui/document/placement.h"
#include "ui/document/port.h"
#include "ui/document/strokerecord.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ps {

/// Bytes that something keeps in memory beyond its own size: of its own, shared with others, and, by their names, of
/// matter that the engine keeps for it. Keys of files that this version does not know are not counted.
struct Weight {
  size_t own = 0;
  std::map<const void*, size_t> shared;
  std::vector<MatterKey> matter;

  void add(const std::string& text) { own += text.capacity() > 15 ? text.capacity() + 1 : 0; }
  void add(const Value& value);
  void add(const ParameterSet& set);
  void add(const Address& address);
  void add(const Body& body);
  void add(const Emitter& emitter);
  void add(const Sink& sink);
  void add(const SceneWall& wall);
  void add(const SceneMaterial& material);
  void add(const Probe& probe);
  void add(const Graph& graph);
  void add(const Marker& marker) { add(marker.name); }
  void add(const Track& track);
  void add(const SceneGroup& group);
  void add(const ThingMarks& marks) { add(marks.thing); }
  void add(const BodyPins& pins);
  void add(const Placement& placement);
  void add(const SceneOrder& order);
  void add(const VoxelShape& shape);
  void add(const VoxelShape::Stroke& stroke);
  void add(const VoxelShape::Paint& paint);
  void add(const SolidShape& shape);
  void add(const BoxShape&) {}
  void add(const BodyConstraint& constraint);
  void add(const SceneEdit& edit);
  void add(const BodyEdit& edit);
  void add(const CellsEdit& edit);
  void add(const RepaintEdit& edit);
  void add(const std::shared_ptr<StrokeRecord>& stroke);
  void add(const std::shared_ptr<const SceneMesh>& mesh);
  void add(const std::shared_ptr<const ProjectState>& state);
  void add(const std::shared_ptr<const Mixture>& mixture);
  void add(const MatterRef& named) {
    if (named) matter.push_back(*named);
  }
  template <class Item>
  void add(const std::optional<Item>& item) {
    if (item) add(*item);
  }
  template <class Item>
  void add(const std::vector<Item>& items) {
    own += items.capacity() * sizeof(Item);
    if constexpr (requires { add(items.front()); }) {
      for (const Item& item : items) add(item);
    }
  }
  template <class Item>
  void add(const PortEdit<Item>& edit) {
    add(edit.before);
    add(edit.after);
    add(edit.matter);
  }
  template <class First, class... Rest>
  requires(sizeof...(Rest) > 0) void add(const First& first, const Rest&... rest) {
    add(first);
    (add(rest), ...);
  }
};

}  // namespace ps
