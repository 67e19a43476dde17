// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/edits.h"
#include "core/simulation/engine.h"
#include "core/simulation/filling.h"
#include "core/simulation/materialtables.h"
#include "core/simulation/matterflow.h"
#include "core/simulation/namedmatter.h"
#include "core/simulation/particlefield.h"
#include "core/simulation/restplaces.h"
#include "core/simulation/scenestate.h"
#include "core/simulation/toolmeter.h"
#include "core/simulation/tracks.h"
#include "core/simulation/truesurface.h"
#include "core/solver/solver.h"

#include <map>

// What an engine holds; private to this room.
namespace ps {

inline std::vector<std::string> idsOf(const std::vector<SceneMaterial>& materials) {
  std::vector<std::string> ids;
  ids.reserve(materials.size());
  for (const SceneMaterial& material : materials) ids.push_back(material.id);
  return ids;
}

/// See Engine::colour().
std::vector<std::pair<uint32_t, uint32_t>> giveColour(ParticleStore& store, const std::vector<uint32_t>& ids,
                                                      uint32_t colour);

struct Engine::Impl {
  Impl(const Project& source, PluginRegistry& registry)
      : project(source),
        materialOrder(idsOf(source.materials)),
        plugins(registry),
        fields(registry),
        shown{source.view.colour} {}

  void build();
  /// An empty scene of particles that are `livingSpacing` m apart, with sets of these constraint plugins first.
  void prepare(double livingSpacing, const std::vector<std::string>& constraints);
  SceneState sceneState() const;
  /// Another one, at a state.
  std::unique_ptr<Impl> restored(const StateReader& reader) const;
  /// From what a project holds, and the names of those of its blocks that nothing here reads.
  std::unique_ptr<Impl> restored(const ProjectState& state, std::vector<std::string>& unread) const;
  /// The project with the materials that the document has, in its order.
  Project document() const;
  /// Another one, built from a project. What throws on the way leaves this one as it was.
  std::unique_ptr<Impl> rebuilt(const Project& source) const;
  /// Index of a body for its particles: a body keeps it as long as particles live, whatever comes and goes before it.
  uint32_t bodyIndex(const std::string& id);
  /// Tells the solver on which surfaces of fixed bodies fluids go.
  void setShapes();
  bool isFixed(const std::string& body) const;  ///< whether it was born fixed
  /// Holds the matter of bodies, or lets it go, as the project says with its tracks laid over it: what a key has let go
  /// would be stopped by what the document says beneath. Matter of emitters is theirs.
  void holdBodies();
  std::vector<uint8_t> heldBodies() const;  ///< Snapshot::heldBodies
  void recompile(const Touched& touched);
  void recompileAll();
  void bakeMaterials(const std::string& only = {});
  void setConstraints();
  /// Adds the structure of matter that has frozen and that nothing takes back.
  void holdFrozen();
  void setThermal();
  uint32_t constraintSet(const std::string& plugin);
  /// The matter of a body that stood like this in the project. `led`: see MoveBody.
  void carry(const Body& from, const RigidMove& move, bool led = false);
  /// Leads the bodies that were born fixed, whatever the document says of them by now; one that has left it stands.
  void lead();
  /// `way`: from where the document has a sketch to where it stands.
  std::vector<uint32_t> born(ColouredSpawn spawn, const Body& body, const RigidMove& way = {});
  void noteRest(const VoxelShape& voxels, const RigidMove& way, std::span<const uint32_t> ids,
                std::span<const api::Double3> places);
  std::vector<uint32_t> born(Spawn spawn, const std::string& id, const std::string& name);
  /// Without those that an emitter holds.
  std::vector<uint32_t> notHeld(const std::vector<uint32_t>& ids) const;
  /// Throws SceneError where the memory does not hold so many particles more of a body.
  void requireRoomFor(double more, const Body& body);
  void measurePouring();
  /// Whether so many particles more may be poured; what they take is then spoken for.
  bool mayPour(size_t more);
  void exchangeMatter();
  /// Looks up what the tracks mean, and goes by them. The project is then the document with what they say at a time
  /// in s laid over it: that of the solver between any two frames, whatever came before.
  void bindTracks(double time);
  /// Goes by them. Where a value cannot be the document's holds, as limits() say.
  void followTracks(double time);
  /// As followTracks(), where they cannot all act together.
  void followEach(double time);
  /// Makes a change of the document beneath its tracks, which throws or may be taken back, and compiles what it
  /// touches.
  void changeBeneath(const std::function<void(Touched&)>& change, const std::function<void()>& takeBack);
  void bindOverlay(Touched& dropped);
  double slack() const;  ///< s, of keys
  /// Tells the solver on what the probes measure forces, and whether its balance is measured.
  void watchForces();
  bool measuresBalance = false;
  std::vector<FieldPtr> shownFields() const;

  Project project;
  std::vector<std::string> materialOrder;  ///< ids of the document's; others in `project` leave at the next reset
  PluginRegistry& plugins;
  ParticleFields fields;
  std::vector<std::string> shown;  ///< names of what snapshots carry
  std::unique_ptr<Solver> solver;
  MaterialTables tables;
  ShapeSurfaces surfaces;
  NamedMatter named;
  TrackOverlay overlay;
  std::map<std::string, uint32_t> constraintSets;  // one per plugin: structure may join matter of any two bodies
  std::shared_ptr<const std::vector<std::string>> bodyIds = std::make_shared<const std::vector<std::string>>();
  std::vector<uint8_t> fixedBodies;    // 1 for bodies that were born fixed, by the same index
  std::vector<std::string> bodyNames;  // for messages, by the index that particles carry
  /// Notes where matter stands at the start, for a probe that asks for it before the first frame.
  void noteStart();
  /// Notes what the project's probes are called.
  void nameProbes();
  std::vector<std::string> probeNames;
  std::shared_ptr<const std::vector<Probe>> measured;  ///< the project's probes, for frames to share
  std::vector<Vector3> start;  ///< m, places at the start by the particles' ids, if a probe has a region
  std::shared_ptr<const RestPlaces> rest = std::make_shared<const RestPlaces>();  ///< for frames to share
  StepReport lastReport;
  MatterFlow flow;
  ToolMeter tools;
  std::optional<Limit> fill;  ///< what whole layers make of the bodies' volumes
  double pouredBytes = 0;     ///< that a particle of an emitter takes
  double pouringRoom = 0;     ///< bytes that emitters may take before the memory is asked again
  double addingRoom = 0;      ///< and what is added by hand
  bool toldFull = false;      ///< that they wait for memory
  uint64_t revision = 0;
  double spacing = 0;  ///< of the particles that live; the project's acts at the next reset
};

}  // namespace ps
