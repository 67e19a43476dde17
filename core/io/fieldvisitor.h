// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/plugin_host/registry.h"
#include "core/scene/project.h"

#include <optional>
#include <string>

namespace ps {

/// Walks over the fields of a project. What a kind of value stands for (a plugin, a material of the scene, a direction)
/// comes through one of the functions here, whatever the key; every object comes after its fields. `pointer` is the
/// JSON pointer of the value.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;

  /// Of any kind where none is said. `withoutIt`: what a missing one means for the scene.
  virtual void plugin(std::optional<PluginKind>, const std::string& /*id*/, const std::string& /*pointer*/,
                      const char* /*withoutIt*/) {}
  virtual void material(const std::string& /*id*/, const std::string& /*pointer*/) {}
  virtual void address(const std::string& /*text*/, const std::string& /*pointer*/) {}
  virtual void colour(const std::string& /*name*/, const std::string& /*pointer*/) {}
  virtual void quantity(const std::string& /*name*/, const std::string& /*pointer*/) {}
  virtual void direction(const Vector3&, const std::string& /*pointer*/) {}
  /// Of a list whose ids must differ: one that stands in it already.
  virtual void repeatedId(const std::string& /*id*/, const std::string& /*pointer*/) {}
  /// The parameters' own keys follow after `pointer`.
  virtual void parameters(const ParameterSet&, api::ParameterList, const std::string& /*pointer*/) {}
  virtual void pluginParameters(const std::string& /*id of the plugin*/, const ParameterSet&,
                                const std::string& /*pointer*/) {}

  virtual void object(const SceneMaterial&, const std::string& /*pointer*/) {}
  virtual void object(const VoxelShape&, const std::string& /*pointer*/) {}
  virtual void object(const SceneMesh&, const std::string& /*pointer*/) {}
  virtual void object(const SolidShape&, const std::string& /*pointer*/) {}
  virtual void object(const Region&, const std::string& /*pointer*/) {}
  virtual void object(const Body&, const std::string& /*pointer*/) {}
  virtual void object(const Emitter&, const std::string& /*pointer*/) {}
  virtual void object(const Sink&, const std::string& /*pointer*/) {}
  virtual void object(const Environment&, const std::string& /*pointer*/) {}
  virtual void object(const Probe&, const std::string& /*pointer*/) {}
  virtual void object(const Graph&, const std::string& /*pointer*/) {}
  virtual void object(const Track&, const std::string& /*pointer*/) {}
  virtual void object(const PackedBlock&, const std::string& /*pointer*/) {}
};

}  // namespace ps
