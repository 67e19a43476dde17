// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/simulation/command.h"
#include "core/simulation/snapshot.h"
#include "core/solver/matter.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace ps {

class NamedMatter;
class ParticleFields;
class PluginRegistry;
class Solver;
class StateReader;
class StateWriter;

/// A scene compiled into a solver, single-threaded from the caller's point of view: the command line uses it directly,
/// the editor through EngineThread. What it hands out is values and const views; it changes by its own functions alone.
class Engine {
 public:
  /// At the state that the project holds; where it cannot go on from there, or holds none, at its start. Throws
  /// SceneError when no scene can be made of the project (contradicting values, too many particles, ...).
  Engine(const Project& project, PluginRegistry& plugins);
  /// At a state that an engine of this document saved, whatever the project holds. Throws as restore().
  Engine(const Project& document, PluginRegistry& plugins, const StateReader& state);
  ~Engine();

  /// Plugins that threw in it are refused from now on, in the registry too.
  StepReport step();
  /// Whether reports of frames tell who gave and took mechanical energy: Solver::measureBalance(), after resets too.
  void measureBalance(bool on);
  /// What could not be delivered: the solver's limits, then those of emitters, of materials' laws, of tracks.
  std::vector<Limit> limits() const;
  /// Asks every plugin for its energies and limits, and names those that threw at it since the last step: they are
  /// refused from now on. For the end of a run, after which no step would tell.
  std::vector<PluginFault> lateFaults();

  // Edits. Each throws, InputError mostly, and then has changed nothing.

  void reset();  ///< back to the start, with all edits kept; never to a state that the project holds
  /// The document changed as a whole (undo, a new body, gravity): takes over every parameter and material at once;
  /// bodies, which are particles by now, at the next reset; how fixed ones move acts at once.
  void update(const Project& project);
  /// A parameter changed: recompiles what it touches; a place carries matter along. Returns false when it acts at the
  /// next reset only, as its declaration says. Where a track holds it, this is what holds without the track.
  bool setParameter(const Address& address, const Value& value);
  /// Several as one edit: what they touch together is compiled once, and all are refused where one is. Returns whether
  /// all act now.
  bool setParameters(std::span<const SetParameter> edits);
  /// Parameters go by these tracks: from the next frame on, and where one has gone, by the document again.
  void setTracks(const std::vector<Track>& tracks);
  /// One of the closed set of edits; those above, and those that name matter.
  void apply(const Command& command);
  /// A body is at another pose from now on, a move away from that of the project. Its matter, wherever it is by now, is
  /// turned by as much about its centre of mass, which goes as far as that of the form does: see Solver::carry().
  /// Nothing happens where the project has no such body. `led`: see MoveBody; what is not fixed is carried all the
  /// same.
  void moveBody(const Body& body, const RigidMove& move, bool led = false);
  /// Matter of one body becomes another one's: see PassMatter. Nothing happens where there is none of it.
  void passMatter(const PassMatter& passed);
  /// Adds a sketched body, or more cells of one that exists, at rest; cells where a live particle is within 0.9
  /// spacings stay free. Returns the ids of the new particles. `way`: see AddCells.
  std::vector<uint32_t> addCells(const Body& body, const std::vector<std::array<int, 3>>& cells, int palette,
                                 const RigidMove& way = {});
  /// Adds a body as it is at the start, without what would stand within 0.9 spacings of a live particle. Returns the
  /// ids of the new particles.
  std::vector<uint32_t> addBody(const Body& body);
  /// Removes particles and keeps them, with all their fields and bonds, for putBack(). Until the next reset. What an
  /// emitter holds stays.
  ExtractedMatter extractParticles(const std::vector<uint32_t>& ids);
  void putBack(const ExtractedMatter& matter);
  /// Makes particles of another material, a SceneMaterial::id: see Solver::paint(). What an emitter holds stays.
  PaintedMatter paint(const std::vector<uint32_t>& ids, const std::string& material);
  /// Gives particles a colour of their own (see colourNumber()), or with 0 that of their material. Their ids with what
  /// they had before, of those that had another one.
  std::vector<std::pair<uint32_t, uint32_t>> colour(const std::vector<uint32_t>& ids, uint32_t colour);
  void unpaint(const PaintedMatter& painted);
  /// Gives particles heat between two frames: see Solver::addHeat().
  bool addHeat(std::span<double> joules);
  /// Changes their velocities: see Solver::addVelocities().
  void addVelocities(std::span<const Vector3> change);
  /// Cuts and welds, and what undo does about them: see Solver::cut().
  TieChange cut(std::span<const Blade> blades, std::span<const uint8_t> isSpared);
  TieChange weld(std::span<const Blade> balls, std::span<const uint8_t> isSpared);
  void undo(const TieChange& change);
  void redo(const TieChange& change);
  /// Ids of live particles whose centre lies in one of the cells of a lattice.
  std::vector<uint32_t> particlesIn(const VoxelShape& lattice, const std::vector<std::array<int, 3>>& cells) const;

  /// All that keys name, with what is out of the scene: what a state does not say, and goes with it to where edits are
  /// repeated.
  std::shared_ptr<const NamedMatter> names() const;
  std::vector<MatterKey> hands() const;  ///< that are in matter now
  void setNames(const NamedMatter& names);

  /// All that goes on into the next frame: the solver's state, what emitters hold, and who is who.
  void save(StateWriter& writer) const;
  /// Goes on as the engine would have that was saved, to the bit, with this one's document. Throws InputError for a
  /// state that is damaged or that the document or the installed plugins cannot go on from, and has then changed
  /// nothing.
  void restore(const StateReader& reader);
  /// As restore(), from what a project holds. Refuses what is not of the bodies that this engine's project has.
  void restore(const ProjectState& state);
  /// Hash of what save() writes.
  uint64_t stateHash() const;
  /// What is to be reported of the state that the project held when this engine was made, "/state: what": why it begins
  /// at its start, or what of the state means nothing here.
  const std::vector<std::string>& remarks() const { return m_remarks; }

  /// Snapshots carry these fields from now on, beside those that each has, instead of what the project's view shows.
  /// Unknown names are left out.
  void show(const std::vector<std::string>& names);
  SnapshotPtr snapshot() const;
  FrameStats stats() const;
  uint64_t revision() const;  ///< Snapshot::revision
  /// As it runs: with what its tracks say now, and materials that have left the document.
  const Project& project() const;
  /// As the document has it, without what is only of the run: what a reset makes.
  Project document() const;
  const Solver& solver() const;
  const ParticleStore& particles() const;
  const ParticleFields& fields() const;  ///< that particles may have, ours and those of the installed plugins
  /// Body::id by the index that particles carry; a body keeps its index until the next reset.
  const std::vector<std::string>& bodyIds() const;
  const std::vector<std::string>& probeNames() const;  ///< "name.quantity[unit]"
  /// Tables of materials baked so far, in all runs of this engine.
  uint64_t bakedTables() const;

 private:
  void openAtState();
  struct Impl;
  std::unique_ptr<Impl> m;
  std::vector<std::string> m_remarks;
};

}  // namespace ps
