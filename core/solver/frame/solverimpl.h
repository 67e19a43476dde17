// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/base/parallel.h"
#include "core/base/statestream.h"
#include "core/solver/contact/impacts.h"
#include "core/solver/contact/liquidcontact.h"
#include "core/solver/contact/rebound.h"
#include "core/solver/contact/rigidcontact.h"
#include "core/solver/contact/shapecontact.h"
#include "core/solver/contact/solidcontact.h"
#include "core/solver/contact/sweptclamp.h"
#include "core/solver/contact/walls.h"
#include "core/solver/fluid/density.h"
#include "core/solver/fluid/gasforces.h"
#include "core/solver/fluid/viscosity.h"
#include "core/solver/frame/balance.h"
#include "core/solver/frame/forcemeter.h"
#include "core/solver/frame/hovering.h"
#include "core/solver/frame/prescribedmotion.h"
#include "core/solver/heat/heat.h"
#include "core/solver/heat/phasestage.h"
#include "core/solver/solver.h"
#include "core/solver/structure/constraintsystem.h"
#include "core/solver/structure/piecelists.h"
#include "core/solver/structure/piecespin.h"

#include <chrono>

namespace ps {

/// Mean density error that no longer deserves the name of a solution.
inline constexpr double kDiverged = 0.5;
/// Mean density error from which on liquid in a heap is a tenth lower than it should be, and flows as such.
inline constexpr double kDense = 0.05;
/// Spacings by which a plugin may move a particle in one substep, beyond the way of its velocity.
inline constexpr double kFarthestLeap = 1000;

/// ms since it was made, and those of them that this thread worked alone.
class StageClock {
 public:
  double passed() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - m_start).count();
  }
  double alone() const { return passed() - 1000 * (secondsShared() - m_shared); }

 private:
  std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
  double m_shared = secondsShared();
};

/// What a solver holds, and one frame cut into its parts. Indices of particles change only in freshLists(), at the
/// start of a frame: whatever is kept by index within a frame stays true.
struct Solver::Impl {
  SolverSettings settings;  ///< with the substeps of the present frame
  int askedSubsteps = SolverSettings().substeps;
  ThermalSettings thermal;
  const api::ThermalPlugin* model = nullptr;
  std::string modelName;
  std::vector<double> modelParameters;
  std::vector<Wall> walls;
  Bounds bounds;
  std::vector<std::string> bodyNames;
  std::vector<BakedMaterial> materials;

  ParticleStore store;
  StateBuffer lastGood;        ///< all of the state as the frame began
  bool lastGoodValid = false;  ///< not after particles were added or removed
  PrescribedMotion motion;
  Neighbours neighbours;
  ConstraintSystem constraints;
  DensityStage density;
  ViscosityStage viscosity;
  WallStage wallStage;
  FixedShapes shapes;
  ShapeContact shapeContact;
  SweptClamp swept;
  SolidContact contact;
  Impacts impacts;
  Rebound rebound;
  /// What is squeezed, or thick, sinks into a lattice. A wider distance, and ice sinks: at 0.8 wholly.
  LiquidContact wet{{0.76, 1}};
  /// A layer one particle thick fills less than half of a liquid particle's kernel. At rest the gaps of a square
  /// lattice let nothing through, 0.71 spacings from four particles; cloth stretched by more than a quarter leaks.
  LiquidContact sheets{{0.9, 2}};
  std::vector<uint32_t> thinSolids;  ///< particles of sheets and lines, ascending
  RigidContact rigid;
  PieceLists pieces;
  PieceSpin pieceSpin;
  std::vector<uint32_t> pieceOf;  ///< of the structure: ConstraintSystem::pieces()
  GasForces gas;
  HeatStage heat;
  PhaseStage phase;

  uint64_t frame = 0, lastSort = 0;
  double time = 0, thermalTime = 0;
  double energyOffset = 0;  ///< J: thermal energy minus the ledger's net, when both were last known to be right
  bool configured = false, modelChanged = false, structureChanged = true, reordered = true;
  std::vector<uint32_t> melted;
  DensityError densityError;     ///< of this frame
  bool overshot = false;         ///< heat steps beyond the stable one left temperatures that cannot be
  std::string leapt;             ///< what went too far in this substep; "": nothing
  std::vector<uint8_t> grouped;  ///< 1 for members of groups
  StepReport report;
  double denseSeconds = 0;   ///< since when liquid has been denser than kDense; no state
  ExternalImpulse external;  ///< kg m/s, in this frame
  ChunkSum weight;
  ForceMeter forces;
  Balance balance;
  Hovering hovering;
  bool anchorsKnown = false;      ///< of `forces`, for the structure as it is
  std::vector<uint32_t> hanging;  ///< what moves and may be pulled by what is fixed, ascending

  Impl();
  void configure();
  void settleEnergy() { energyOffset = heat.energy(store) - heat.ledger().net(); }
  /// `others`: who is there, or where, is no longer the same, so that lists are of no use.
  void matterChanged(double energyBefore, bool others = true);
  /// By hand: renews what depends on them.
  /// New matter, of ascending indices that end with the last, by the constraints of `sets`.
  void tie(std::span<const uint32_t> sets, std::span<const uint32_t> members);
  TieChange tiesChanged(TieChange change);
  void changeTies(const TieChange& change, bool made);
  PaintedMatter::Books books() const { return {heat.ledger(), energyOffset}; }
  /// Of paint() and unpaint(): the state of particles at these ascending indices, whose material is another one by now,
  /// from their temperatures. `mass` in kg, one each; 0: as the room takes that it fills.
  void startAnew(std::span<const uint32_t> indices, std::span<const float> mass);

  void chooseSubsteps();
  void startLeads();
  void runFrame();
  bool advance();
  bool needsLists() const;
  void freshLists();
  /// For a hand, which ties and parts in each frame: often the lists still hold.
  void holdLists() {
    if (needsLists()) freshLists();
  }
  /// Whether something lies so many images away from the periodic box that single precision begins to tell.
  bool strayed() const;
  /// In a periodic box: brings back what has left it. What is tied together moves as one, and when it has strayed.
  void wrapIntoPeriod();
  void bringPiecesHome(const StructureGraph& graph);
  void save(StateWriter& writer) const;
  void restore(const StateReader& reader);
  void keepLastGood();
  void backToLastGood();
  void listsChanged(bool newStructure);
  void refreshLiquidContact();
  void substep(uint32_t index);
  void changeVelocities(uint32_t index, double dt);  ///< once they follow from places
  int structurePasses() const;
  void iterate(uint32_t index, double dt);
  void predict(uint32_t index, double dt);
  Vector3 momentum();               ///< kg m/s, of what moves
  Vector3 momentumOfHanging();      ///< kg m/s
  Vector3 displacementOfHanging();  ///< kg m, since the start of the substep
  /// Calls into plugins, and books what comes from outside: nothing, unless something hangs on what is fixed.
  template <class Call>
  void structure(Call&& call, double dt);
  void bookContact(double dt);
  void findThinSolids();
  void velocities(double dt);
  /// False when the thermal model threw; the frame is then taken back.
  bool exchangeHeat();
  void changePhases();
  void checkBounds();
  /// J by which the heat balance is open; 0 within what rounding explains.
  double openEnergy();
  void checkEnergy();
  void measureDensity();
  void judgeDensity();
  void closeFrame();
  /// Id of the first particle whose position, velocity or temperature is no finite number, or -1.
  int64_t firstNotFinite(std::string& what) const;
  /// Whether all of these are finite numbers.
  bool allFinite() const;
  bool rejectIfNotFinite();
  void noteLeaps(double dt);
  bool rejectIfLeapt();
  bool rejectIfUnphysical();
  /// "; plugin 'x' moved it", or "" when none did. To be called when the frame has been taken back.
  std::string whoMovedIt();
  std::vector<PluginFault> drainFaults();
  /// "particle 17 of 'Ice block'".
  std::string describe(size_t i) const;
  void raise(StepFlag flag, const std::string& message);

  template <class Call>
  void timed(Stage stage, Call&& call) {
    const StageClock clock;
    call();
    report.milliseconds[static_cast<size_t>(stage)] += clock.passed();
    report.serialMilliseconds[static_cast<size_t>(stage)] += clock.alone();
  }
};

}  // namespace ps
