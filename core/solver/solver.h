// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/math/rigidmove.h"
#include "core/matter/material.h"
#include "core/particles/particlestore.h"
#include "core/particles/reactions.h"
#include "core/solver/anyconstraint.h"
#include "core/solver/bodyheat.h"
#include "core/solver/fixedshape.h"
#include "core/solver/heatsource.h"
#include "core/solver/matter.h"
#include "core/solver/motion.h"
#include "core/solver/report.h"
#include "core/solver/settings.h"

#include <phasesketch/thermal.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ps {

class StateReader;
class StateWriter;

/// One engine: substepped XPBD (Macklin et al. 2019) with position-based density (Macklin & Mueller 2013, volume form
/// of Solenthaler & Pajarola 2008), structural and neighbour constraints from plugins, XSPH or
/// implicit viscosity, enthalpy heat, phase change. Gather, not scatter: every loop writes its own particle only, so
/// the result is the same for any number of threads and any instruction set.
class Solver {
 public:
  Solver();
  ~Solver();

  // Configuration; each may be called between steps and acts on the next one.
  void setSettings(const SolverSettings& settings);
  /// `name` is the model's id, for messages.
  void setThermal(const ThermalSettings& settings, const api::ThermalPlugin* model, std::string name,
                  std::vector<double> modelParameters);
  void setWalls(std::vector<Wall> walls);
  /// Instead of those before; see FixedShape for how long each stands for its body's particles.
  void setShapes(std::vector<FixedShape> shapes);
  /// Throws InputError when a periodic box is too small for the reach of its particles; so does setSettings().
  void setBounds(const Bounds& bounds);
  /// What messages call the bodies, by index.
  void setBodyNames(std::vector<std::string> names);
  /// Indices of materials must keep their meaning while particles live.
  void setMaterials(std::vector<BakedMaterial> materials);
  /// Another table in place of one of them.
  void setMaterial(size_t index, BakedMaterial material);
  std::span<const BakedMaterial> materials() const;
  /// Adds a set of constraints of one plugin; returns its index. `name` is the plugin's id, for messages; `parameters`
  /// are those of bodies that have none of their own.
  uint32_t addConstraintSet(const AnyConstraint& plugin, std::string name, std::vector<double> parameters);
  void setConstraintParameters(uint32_t set, uint32_t body, std::vector<double> parameters);

  /// How the fixed particles of a body move, those to come too; the body goes on from where it is.
  void setMotion(uint32_t body, const BodyMotion& motion);

  /// Walls, by index, and bodies whose forces are to be measured from the next frame on, instead of those before.
  void watchForces(std::span<const uint32_t> walls, std::span<const uint32_t> bodies);
  /// Mean over the last frame of all but gravity, in N, and its torque about the origin, in N m: on what moves of a
  /// body and on what is fixed of it, or on a wall. Nothing before such a frame. See ForceMeter for what it cannot do.
  std::optional<Wrench> forceOnWall(size_t wall) const;
  std::optional<Wrench> forceOnBody(uint32_t body) const;

  /// Whether reports tell who gave and took mechanical energy, from the next frame on. Takes a pass over all particles
  /// for each stage; moves nothing by a bit.
  void measureBalance(bool on);

  /// Plugins that warm or cool matter, whatever the model; those that threw stay put aside.
  void setHeatSources(std::vector<HeatSource> sources);
  /// What heat each body is given, by index; bodies beyond the list get none. See BodyHeating.
  void setHeating(std::span<const BodyHeat> bodies);

  /// Returns the ids of the new particles. Mass is rest density of the state at birth times Spawn::volume.
  std::vector<uint32_t> spawn(const Spawn& spawn);
  /// Fluid begins as dense as it lies, without a push: what a density sum over places in disorder has too much, some
  /// hundredths, is let go in tenths of a second. When all that is around them has been born.
  void settle(std::span<const uint32_t> ids);
  /// Lets held particles go at the velocity that they have; ids already gone are skipped.
  void release(std::span<const uint32_t> ids);
  /// Whether the matter of bodies is held, by index, where it stands; what is let go sets off from rest. What is fixed
  /// stays so, and bodies beyond the list, or of Hold::AsItIs, stay as they are.
  void hold(std::span<const Hold> bodies);
  /// Removes particles by id; ids already gone are skipped. Their energy is booked as a source.
  void remove(std::span<const uint32_t> ids);
  /// As remove(), and keeps what was there for putBack().
  ExtractedMatter extract(std::span<const uint32_t> ids);
  /// Puts matter back where it was, under its ids, with its constraints to whatever still lives. Of the same solver;
  /// throws Error when one of the ids is alive.
  void putBack(const ExtractedMatter& matter);

  /// Makes particles of another material, in the places and at the velocities that they have: each keeps its
  /// temperature, and is in the phase in which its material is in balance there. It fills as much room as before, what
  /// was a gas that of a cell, so that its mass is another one; what is fixed or held stays so. Energy is booked as a
  /// source. What ties it to others stays as long as it is solid. Ids already gone are skipped, and what is of the
  /// material already.
  PaintedMatter paint(std::span<const uint32_t> ids, uint32_t material);
  /// Takes that back, wherever they are by now: what has neither been warmed nor changed since is as it was to the bit,
  /// books too where nothing else came into them; all else keeps the temperature that it has by now, and has its mass
  /// of before. Those that are gone, or of another material again, are skipped.
  void unpaint(const PaintedMatter& painted);

  /// Particles of one body are another one's from now on, by its index: what has come apart. They stay as they are, and
  /// tied as they were; the other one is tied by the same plugins with the same parameters until others are set. Those
  /// that are gone, or of another body than `from`, are skipped.
  void pass(std::span<const uint32_t> ids, uint32_t from, uint32_t to);

  /// Carries all particles of a body to another place: turns them about the mean of their places, which goes by `way`
  /// m. What structure ties to them comes along, but for what is fixed of other bodies. Each keeps its temperature and
  /// its velocity against the others; their mean velocity stays, so that kinetic energy and momentum do. What ties them
  /// to something that stays is stretched. What weight gains or loses is work from outside, between two frames
  /// (MechanicalRecord: the end of one and the start of the next).
  void carry(uint32_t body, const Quaternion& turn, const Vector3& way);

  /// As carry() of what is fixed of a body, but through what is in its way, from the next frame on: matter is met,
  /// pushed and scooped up as by any body that moves. In each frame it goes half of what is left of the way, at 20 m/s
  /// at most, and so trails behind a hand; several calls add up. On top of how setMotion() has it move.
  void lead(uint32_t body, const Quaternion& turn, const Vector3& way);
  /// m that the particle of a body has still to go that lead() takes farthest.
  double leadLeft(uint32_t body) const;
  /// J that melting and boiling have taken up in a particle, by its index; 0 without a thermal model.
  double latentHeat(size_t particle) const;
  /// J in what is fixed of a body; 0 without a thermal model.
  double heatOfFixed(uint32_t body) const;

  /// Gives particles heat between two frames, J each in the order of particles(); below 0 it is taken, as far as 1 K.
  /// Leaves what each got in `joules`, and books it as heaters. False without a thermal model: nobody got any.
  bool addHeat(std::span<double> joules);
  /// Changes velocities between two frames, by m/s each in the order of particles(); what is fixed or held stays. Work
  /// from outside, as carry() has it.
  void addVelocities(std::span<const Vector3> change);

  /// Breaks ties across blades, and parts groups there, except of bodies that are spared, by their index. Between two
  /// frames; what they had stored goes, as where ties melt. Those who were tied there are not joined again by
  /// themselves while both stay solid. What it did, for undo.
  TieChange cut(std::span<const Blade> blades, std::span<const uint8_t> isSpared);
  /// Ties what is solid and touches within the balls of blades, of bodies whose structure offers that (kWeldsMatter),
  /// at rest as it stands. It may join by itself again there.
  TieChange weld(std::span<const Blade> balls, std::span<const uint8_t> isSpared);
  /// Takes a cut or a weld back by the particles' ids, wherever they are by now, or makes it again. Ties whose
  /// particles are not all alive stay away; those that come back are as long at rest as they were.
  void undo(const TieChange& change);
  void redo(const TieChange& change);

  /// One frame. On NotFinite the state goes back to where the last good frame began, clocks and all.
  StepReport step();

  ParticleStore& particles();
  const ParticleStore& particles() const;
  size_t constraintCount() const;
  /// For each particle which piece of solid matter it belongs to: a number that all share whom structure ties together.
  /// kNoPiece for loose matter.
  std::vector<uint32_t> pieces() const;
  static constexpr uint32_t kNoPiece = ~0u;
  double time() const;         ///< s, mechanical
  double thermalTime() const;  ///< s, thermal_time_scale times as fast
  uint64_t frame() const;
  std::vector<Limit> limits() const;
  const HeatLedger& heatLedger() const;
  double thermalEnergy() const;                     ///< J
  std::span<const double> thermalEnergies() const;  ///< J per particle, until the next call; empty without a model
  /// Plugins that threw when they were asked for energies and limits since the last step or call; none of them goes on.
  std::vector<PluginFault> drainFaults();
  double elasticEnergy() const;  ///< J, stored in constraints, as their plugins say
  /// All that goes on into the next frame: matter with every field and its order, structure, prescribed motions, what
  /// contacts bore, books, clocks. Changes of settings that are to come take effect first.
  void save(StateWriter& writer) const;
  /// Goes on as the solver would have that was saved, to the bit. Settings, materials, constraint sets and the thermal
  /// model must have been set as they were there. Throws InputError for a state of another scene, or one that is
  /// damaged; the solver must then not be used any more.
  void restore(const StateReader& reader);
  /// Hash of what save() writes.
  uint64_t stateHash() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m;
};

/// Instruction sets that this machine runs and this binary holds, Highway's names, best first ("AVX3", "AVX2", ...).
std::vector<std::string> availableInstructionSets();
/// Pins one ("" for the best). Throws InputError with the choices for an unknown or unavailable name.
void setInstructionSet(const std::string& name);
std::string instructionSet();

}  // namespace ps
