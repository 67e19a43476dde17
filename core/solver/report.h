// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/types.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

// What the solver tells of a frame: plain values, without any stage of it.
namespace ps {

/// Failures of a step; each says what to do about it.
enum class StepFlag : unsigned {
  NotFinite = 1,     ///< a NaN or infinity: raise substeps, or undo the last change of a stiffness or temperature
  LostParticle = 2,  ///< a particle left the bounds: raise substeps, or close the scene with walls
  Diverged = 4,      ///< density error above 50 %, in the mean over liquid that is 1 % of what moves, or more: raise
                     ///< substeps (finersteps.h)
  PluginFault = 8,   ///< a plugin threw: see the message; the scene goes on without it
  EnergyOpen = 16,   ///< heat balance open by more than 1e-6 of what was exchanged: report a bug in the thermal model
  Unphysical = 32,   ///< a temperature below 0 K, shares outside 0 .. 1, a leap across the scene: see who is named
};
using StepFlags = unsigned;
/// With these the frame was taken back, and would be again: nothing moves any more.
inline constexpr StepFlags kTakenBack =
    static_cast<StepFlags>(StepFlag::NotFinite) | static_cast<StepFlags>(StepFlag::Unphysical);
/// "not_finite", "lost_particle", ...
std::vector<std::string> flagNames(StepFlags flags);

/// A plugin that threw, and what it said; the solver goes on without it.
struct PluginFault {
  std::string plugin;  ///< id
  std::string what;
};

/// Asked for and not delivered at this step.
struct Limit {
  std::string what;  ///< parameter key and owner: "water.youngs_modulus", "rope.stretch_stiffness"
  double asked = 0, delivered = 0;
  std::string unit;
  int body = -1;  ///< the one whose plugin's own parameter it is; -1: a material's, the solver's
  /// Of a curve or law that leaves its property's range: from where to where, K; 0 and infinity where it goes on.
  std::optional<std::array<double, 2>> kelvin{};
  /// What the numbers say, as the end of a sentence that begins with `what`, where they are more than what a step does
  /// not reach: "it should sink, but particles of this spacing hold it". "": nothing to add.
  std::string why{};
  /// What would help, as `--set` and the editor's links take it: "solver/particle_spacing=0.01"; "": nothing that is
  /// known, or more substeps.
  std::string use{};
};

/// "solver/particle_spacing=0.01", as Limit::use has it.
std::string useOf(const char* address, double value);

enum class Stage { Neighbours, Density, Structure, Contact, Viscosity, Heat, Phase, Count };
const char* stageName(Stage stage);

/// Heat that entered the particles since the start, in J; `exchanged` adds up absolute amounts. `radiation` is what
/// came from around the scene: walls' is theirs, and what particles radiate at each other stays. `heaters`: bodies'
/// heating power and sources of the thermal model. `sources`: what came and went with matter, or by another thermal
/// model.
struct HeatLedger {
  double walls = 0, air = 0, radiation = 0, heaters = 0, sources = 0, exchanged = 0;
  double airWarming = 0;  ///< K by which a finite lump of air is warmer than at the start
  double net() const { return walls + air + radiation + heaters + sources; }
  bool operator==(const HeatLedger&) const = default;
};

/// Momentum of moving matter over one frame, kg m/s. What is open, end - start - external, is rounding: forces between
/// particles come in pairs.
struct MomentumRecord {
  api::Double3 start{0, 0, 0}, end{0, 0, 0};
  /// Impulse of all that is no moving matter: gravity, air, damping, walls, fixed particles and what hangs on them.
  api::Double3 external{0, 0, 0};
};

/// Mechanical energy of what moves over one frame, in J, and its angular momentum about the origin, in kg m2/s. The
/// parts of `given` add up to what the frame gained, to rounding. What structure stores is not counted, but where it
/// gives and takes; friction and inelastic contact are one: Contact.
struct MechanicalRecord {
  /// Surroundings: gravity's steps, air, damping, what leads. Structure: constraints and groups, stored and lost.
  /// Pressure: of liquids. Contact: solids, walls, fixed matter, liquid on solids, with friction. Impact: restitution.
  /// Scheme: velocities of first order, and what gives the spin back that they lose.
  enum class Part { Surroundings, Structure, Pressure, Contact, Viscosity, Impact, Scheme, Count };
  bool measured = false;
  double kineticStart = 0, kineticEnd = 0, potentialStart = 0, potentialEnd = 0;
  std::array<double, static_cast<size_t>(Part::Count)> given{};
  api::Double3 angularStart{0, 0, 0}, angularEnd{0, 0, 0};
  /// Of gravity, air, damping, walls, and fixed particles with what hangs on them.
  api::Double3 angularExternal{0, 0, 0};
};
const char* partName(MechanicalRecord::Part part);

/// Limits that are no parameter's: the heat balance is open by so many joules; liquid is too dense by this mean excess
/// while a body is led, or solids are squeezed themselves, which may leave it no room; a gap of so many metres, across
/// which heat is radiated, is narrower than the one that particles can show.
inline constexpr const char* kBalanceLimit = "heat balance";
inline constexpr const char* kSqueezeLimit = "squeezed liquid";
inline constexpr const char* kGapLimit = "narrow gap";

struct StepReport {
  StepFlags flags = 0;
  std::string message;  ///< the culprit: "particle 17 of 'Ice block': position is not finite"
  std::vector<PluginFault> faults;
  std::array<double, static_cast<size_t>(Stage::Count)> milliseconds{};
  double totalMilliseconds = 0;
  /// Of these, what one thread did alone, however many there were: what was outside of loops that they can share.
  std::array<double, static_cast<size_t>(Stage::Count)> serialMilliseconds{};
  double totalSerialMilliseconds = 0;
  double densityErrorMean = 0, densityErrorMax = 0;  ///< fraction, liquid particles, after the last iteration
  int viscosityIterations = 0;                       ///< of the implicit viscosity, the most of a substep
  MomentumRecord momentum;
  MechanicalRecord mechanical;  ///< where Solver::measureBalance() asks for it
};

}  // namespace ps
