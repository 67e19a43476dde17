// SPDX-License-Identifier: Apache-2.0
#include "ui/document/weight.h"

namespace ps {

void Weight::add(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) add(*text);
  const auto* response = std::get_if<Response>(&value);
  if (!response) return;
  own += response->points.capacity() * sizeof(CurvePoint) + response->coefficients.capacity() * sizeof(double);
  add(response->law);
}

void Weight::add(const ParameterSet& set) {
  constexpr size_t kNode = 32;  // of a tree: three pointers and a colour
  for (const auto& [key, value] : set.values) {
    own += kNode + sizeof(key) + sizeof(value);
    add(key);
    add(value);
  }
}

void Weight::add(const Address& address) { add(address.id, address.key, address.plugin); }

void Weight::add(const VoxelShape::Paint& paint) { add(paint.material, paint.colour); }

void Weight::add(const VoxelShape::Stroke& stroke) {
  add(stroke.brush, stroke.parameters);
  own += stroke.samples.capacity() * sizeof(stroke.samples.front());
  if (stroke.symmetry) add(stroke.symmetry->mirror);
  if (stroke.stamp) add(stroke.stamp->cells);
}

void Weight::add(const VoxelShape& shape) { add(shape.palette, shape.runs, shape.strokes); }

void Weight::add(const SolidShape& shape) { add(shape.parameters, shape.meshId, shape.mesh); }

void Weight::add(const BodyConstraint& constraint) { add(constraint.plugin, constraint.parameters); }

void Weight::add(const Body& body) {
  add(body.id, body.name, body.material, body.parameters, body.pins, body.constraints);
  std::visit([this](const auto& shape) { add(shape); }, body.shape);
}

void Weight::add(const Emitter& emitter) { add(emitter.id, emitter.name, emitter.material, emitter.parameters); }

void Weight::add(const Sink& sink) { add(sink.id, sink.name, sink.parameters); }

void Weight::add(const SceneWall& wall) { add(wall.id, wall.name, wall.parameters); }

void Weight::add(const SceneMaterial& material) {
  add(material.id, material.label, material.base, material.properties, material.parameters, material.adheresTo,
      material.mixture, material.tags);
}

void Weight::add(const Probe& probe) {
  add(probe.id, probe.name, probe.quantity, probe.body, probe.wall, probe.material, probe.phase);
}

void Weight::add(const Graph& graph) { add(graph.id, graph.title, graph.series, graph.field, graph.body); }

void Weight::add(const Track& track) { add(track.parameter, track.keys); }

void Weight::add(const SceneGroup& group) { add(group.id, group.name, group.members); }

void Weight::add(const BodyPins& pins) { add(pins.id, pins.boxes, pins.chosen); }

void Weight::add(const Placement& placement) {
  add(placement.bodies, placement.emitters, placement.sinks, placement.walls, placement.probes, placement.pins);
}

void Weight::add(const SceneOrder& order) {
  add(order.groups, order.bodies, order.emitters, order.sinks, order.walls, order.probes);
}

void Weight::add(const BodyEdit& edit) { add(edit.id, edit.before, edit.after); }

void Weight::add(const CellsEdit& edit) { add(edit.id, edit.cells, edit.strokes, edit.added); }

void Weight::add(const RepaintEdit& edit) {
  add(edit.id, edit.cells.before, edit.cells.after, edit.cells.added, edit.strokes);
}

void Weight::add(const SceneEdit& edit) {
  std::visit([this](const auto& one) { add(one); }, edit);
}

void Weight::add(const std::shared_ptr<StrokeRecord>& stroke) {
  if (!stroke) return;
  Weight held;
  held.own = sizeof(StrokeRecord);
  held.add(stroke->material, stroke->body, stroke->cells, stroke->lattice, stroke->edits, stroke->deed);
  shared[stroke.get()] = held.own;
  shared.merge(held.shared);
  add(stroke->matter);
}

void Weight::add(const std::shared_ptr<const SceneMesh>& mesh) {
  if (!mesh) return;
  Weight held;
  held.own = sizeof(SceneMesh);
  held.add(mesh->id, mesh->name, mesh->points, mesh->triangles, mesh->origin);
  shared[mesh.get()] = held.own;
}

void Weight::add(const std::shared_ptr<const ProjectState>& state) {
  if (!state) return;
  size_t bytes = sizeof(ProjectState);
  for (const PackedBlock& block : state->blocks) bytes += sizeof(block) + block.name.capacity() + block.data.capacity();
  for (const ProjectState::Shape& body : state->bodies)
    bytes += sizeof(body) + body.id.capacity() + body.stamp.capacity();
  shared[state.get()] = bytes;
}

void Weight::add(const std::shared_ptr<const Mixture>& mixture) {
  if (!mixture) return;
  Weight held;
  held.own = sizeof(Mixture);
  for (const Mixture::Part* part : {&mixture->first, &mixture->second})
    held.add(part->label, part->properties, part->adheresTo);
  shared[mixture.get()] = held.own;
}

}  // namespace ps
