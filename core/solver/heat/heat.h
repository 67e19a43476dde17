// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/thermal.h>

#include "core/base/callee.h"
#include "core/base/progress.h"
#include "core/base/shorttext.h"
#include "core/matter/material.h"
#include "core/particles/neighbours.h"
#include "core/solver/heat/bodyflux.h"
#include "core/solver/heat/enthalpycurves.h"
#include "core/solver/heat/heatbody.h"
#include "core/solver/heat/heatpairs.h"
#include "core/solver/heat/heatsources.h"
#include "core/solver/heat/heatsurroundings.h"
#include "core/solver/heatsource.h"
#include "core/solver/report.h"
#include "core/solver/settings.h"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ps {

class StateReader;
class StateWriter;

/// The thermal half of a frame: pairwise conduction (Cleary & Monaghan 1999 between materials, Kirchhoff within one),
/// walls, air and radiation (HeatSurroundings), film condensation, nucleation. Heat is exchanged in equal and opposite
/// joules, so that a closed system keeps its energy to rounding. Kinds of heat a model cannot do: see the thermal
/// plugin's help.
///
/// Explicit substeps of thermal_cfl times the Gershgorin limit, measured before each from the pairs at hand; above
/// kMaxExplicit of them, pairwise exponential sweeps (heatrelax.cpp), which stay stable at any step and lose accuracy:
/// a front that freezes from a wall lags by 9 % in frames of 45 explicit steps, by 16 % in frames of 150. That is what
/// HeatSteps::Explicit is for. What even sweeps cannot follow is not done: the thermal clock then runs slower, see
/// thermalTimeScaleDelivered(). A model's own pair law is never swept; it is stepped at the limit of the host's
/// conduction and of what the model says of its law (api::PairRates), or else of the former alone. Not modelled:
/// evaporation below the boiling point.
///
/// Where all is as warm as everything around it, to 1e-9 K, nothing is exchanged and no pairs are made: the model is
/// told that the whole frame's time has passed.
///
/// A finite lump of air (airHeatCapacity) keeps one temperature, which follows what it gives and takes; its energy and
/// the particles' are constant together.
///
/// Fixed matter that is held at a temperature (BodyHeat) is a bath: what it gives and takes is booked as heaters', and
/// it has none of its own inertia. Heat enters it from half a spacing before its outermost particles, through its own
/// material: what conducts well has its temperature on its surface.
///
/// Fixed matter that gives a flux by its surface is insulated; what it gives is booked as heaters' (BodyFlux).
///
/// What sources and walls of given flux take leaves each particle at 1 K at least.
///
/// A model that throws is put aside for good: from then on no heat flows, and takeFault() tells what it said.
class HeatStage {
 public:
  static constexpr int kMaxExplicit = 40;        ///< explicit substeps per frame
  static constexpr int kMostExplicit = 1000000;  ///< of HeatSteps::Explicit
  static constexpr int kMaxSweeps = 12;          ///< exponential sweeps per frame
  static constexpr double kSweepLength = 20;     ///< longest sweep in units of the Gershgorin limit
  static constexpr double kColdest = 1;          ///< K, where the tables of materials begin

  /// References stay valid until the next configure(). `model` may be nullptr: no heat flows.
  void configure(const ThermalSettings& settings, const SolverSettings& solver, std::vector<Wall> walls,
                 const Bounds& bounds, std::span<const BakedMaterial> materials, const api::ThermalPlugin* model,
                 std::vector<double> modelParameters);
  /// Sets state, temperature and fractions of particles [first, last); the two spans hold one value per particle of
  /// that range. Declares the model's fields in the store when they are new. False when the model threw.
  bool initialise(ParticleStore& store, size_t first, size_t last, std::span<const double> temperature,
                  std::span<const api::Phase> phase);
  /// Of particles at these ascending indices, whose material is another one by now: from temperature and phase as the
  /// store has them.
  bool initialise(ParticleStore& store, std::span<const uint32_t> indices);
  /// One frame of `dt` s of mechanical time. Lists must be fresh. Updates temperature and fractions, not volumes.
  /// False when the model threw: particles are then half changed, the ledger is not.
  /// `frame`, its number, chooses the rays of radiation. Pairs lie in `room` where somebody lends one.
  bool advance(ParticleStore& store, const Neighbours& neighbours, double dt, uint64_t frame = 0,
               PairRoom* room = nullptr);
  /// Gives each particle joules[i] J at once, while no time passes; below 0 they are taken as far as kColdest, in
  /// rounds that a plateau may need several of. Leaves what each got, and books it as heaters. False without a model,
  /// and when it threw.
  bool give(ParticleStore& store, std::span<double> joules);
  /// Temperature and fractions after a change of pressure or material. Pressure moves the points of balance, and matter
  /// keeps its energy; where a material's enthalpy curves are others, it keeps its temperature and what of it has
  /// melted or boiled, and the energy that this takes is booked as a source.
  void derive(ParticleStore& store);
  /// J, the model's, summed in order of index chunks. Not to be called from two threads at once. Of a model put aside,
  /// what it said last.
  double energy(const ParticleStore& store) const;
  /// Energy of each particle in J; valid until the next call of anything here. Empty without a model.
  std::span<const double> energies(const ParticleStore& store) const;
  /// J that melting and boiling have taken up in a particle, above solid matter as warm; 0 without a model.
  double latentHeat(const ParticleStore& store, size_t i) const;
  const HeatLedger& ledger() const { return m_ledger; }
  /// K; a finite lump of air is warmer than at the start by what matter gave it.
  double airTemperature() const { return m_settings.ambientTemperature + m_ledger.airWarming; }
  /// Particles have another order: what was measured of their surfaces is measured anew.
  void reordered(const ParticleStore& store) {
    if (!m_surroundings.surface().fits(store)) m_surroundings.surface().forget();
  }
  void save(StateWriter& writer, const ParticleStore& store) const;
  /// After the store, which must have the fields of the model. A model that has been put aside here stays so. What was
  /// saved with other enthalpy curves is brought up to these, as derive() does.
  void restore(const StateReader& reader, ParticleStore& store);
  /// Joules that left or came with removed or added particles are booked here.
  void book(double joules) {
    m_ledger.sources += joules;
    m_ledger.exchanged += joules < 0 ? -joules : joules;
  }
  /// The books as they were: of what has been taken back to the bit.
  void setLedger(const HeatLedger& ledger) { m_ledger = ledger; }
  /// Plugins that warm or cool matter, whatever the model; one that throws is put aside for good.
  void setSources(std::vector<HeatSource> sources, ParticleStore& store) { m_sources.set(std::move(sources), store); }
  /// Those that threw since the last call.
  std::vector<PluginFault> drainSourceFaults() { return m_sources.drainFaults(); }
  /// s of the scene and of its thermal clock, for plugins.
  void setClock(double time, double thermalTime) { m_time = time, m_thermalTime = thermalTime; }
  /// Power of bodies, whatever the model.
  BodyHeating& bodyHeating() { return m_bodyHeating; }
  /// False without a model, and when it was put aside.
  bool works() const { return m_model != nullptr && !m_putAside; }
  /// The model's id, for messages and crashes.
  void setModelName(std::string name) { m_modelName = std::move(name); }
  /// What the model said when it threw; once.
  std::optional<std::string> takeFault() { return std::exchange(m_fault, std::nullopt); }
  /// True when the model drops or invents heat by design (api::kOpensEnergy).
  bool opensEnergy() const { return works() && m_model->extension(api::kOpensEnergy) != nullptr; }

  /// Thermal seconds per mechanical second that the last frame really did; below ThermalSettings::timeScale where the
  /// heat would have been too fast for kMaxSweeps sweeps.
  double thermalTimeScaleDelivered() const { return m_delivered; }
  /// Radiation::narrowestGap().
  double narrowestGap() const { return m_surroundings.narrowestGap(); }
  /// Largest stable explicit step as last measured, in s of thermal time: min over particles of m c / sum of G.
  double gershgorinLimit() const { return m_limit; }
  /// True when the last frame used exponential sweeps, for all or the rest of its time.
  bool usedSweeps() const { return m_swept; }

 private:
  template <class Ledger, class Visit>
  static void eachOf(Ledger& ledger, Visit&& visit);
  struct Partial : HeatBooks {
    double fastest = 0;  ///< largest rate in 1/s
    int boiling = 0;
  };

  /// Calls what calls the model; false when the model is aside already or throws now.
  template <class Call>
  bool guarded(Call&& call) const {
    if (!works()) return false;
    const CalleeScope callee(m_modelName.c_str());
    try {
      call();
      return true;
    } catch (const Cancelled&) {
      throw;
    } catch (const std::exception& problem) {
      m_fault = shortText(problem.what());
    } catch (...) {
      m_fault = "threw something that is no std::exception";
    }
    m_putAside = true;
    return false;
  }
  api::ThermalContext context() const;
  void startState(ParticleStore& store, size_t first, size_t last, std::span<const double> temperature,
                  std::span<const api::Phase> phase);
  void startFields(ParticleStore& store) const;
  void bringUpToDate(ParticleStore& store);
  bool isUpToDate() const;
  bool countsAnew(uint32_t material) const;
  void countAnew(ParticleStore& store);
  void noteCurves();
  void restoreCurves(const StateReader& reader);
  void exchange(ParticleStore& store, const Neighbours& neighbours, double dt, uint64_t frame, PairRoom* room);
  void hold(ParticleStore& store);
  bool isHeld(const ParticleStore& store, size_t i) const {
    return m_bodyHeating.holds() && m_bodyHeating.heldAt(store, i) > 0;
  }
  bool isBalanced(ParticleStore& store, const api::ParticleView& view, const api::NeighbourView& lists, double time);
  void passTime(ParticleStore& store, const api::ParticleView& view, double time);
  void deriveRange(ParticleStore& store, size_t first, size_t last);
  void snapshotRange(const ParticleStore& store, HeatInstant& instant, size_t first, size_t last) const;
  void prepare(ParticleStore& store, const Neighbours& neighbours, uint64_t frame, PairRoom* room);
  void sumConductances(const ParticleStore& store, size_t first, size_t last, Partial& partial);
  void collectFrameHeat(ParticleStore& store, const api::ParticleView& view, double frame);
  void filmHeat(const ParticleStore& store, size_t i, double frame, Partial& partial);
  void countBoiling(const ParticleStore& store, size_t first, size_t last);
  void nucleate(const ParticleStore& store, size_t first, size_t last);
  bool boils(const ParticleStore& store, size_t i) const;
  double latentContent(const ParticleStore& store, size_t i) const;
  double fastestRate(const ParticleStore& store, const HeatInstant& now, size_t first, size_t last) const;
  void findLimit();
  double explicitTime() const;
  double sweepTime() const;
  double explicitShare() const;
  int mostExplicit() const;
  static void book(HeatBooks& books, HeatSurroundings::Kind kind, double joules);
  double airHeat() const;
  void takeFromAir(double joules);
  double takeExplicitSteps(ParticleStore& store, const api::ParticleView& view, const api::NeighbourView& lists,
                           double time);
  double takeSweeps(ParticleStore& store, const api::ParticleView& view, double time);
  void explicitStep(ParticleStore& store, const api::ParticleView& view, const api::NeighbourView& lists, double step,
                    bool firstStep);
  void gather(const ParticleStore& store, double step, size_t first, size_t last, Partial& partial);
  void askPairLaw(const api::ParticleView& view, const api::NeighbourView& lists);
  void gatherPairLaw(const api::NeighbourView& lists, double step, size_t first, size_t last);
  double aboveColdest(const ParticleStore& store, size_t i) const;
  /// What is given, to whom, and in which chunks of particles they are.
  struct Gift {
    std::vector<uint32_t> rows;
    std::vector<double> left;  ///< J
    std::vector<uint32_t> chunks;
  };
  bool giveRound(ParticleStore& store, Gift& gift);
  double shareToTake(const ParticleStore& store, size_t i, double joules) const;
  void addFrameHeat(const ParticleStore& store, double step, bool firstStep, size_t first, size_t last,
                    Partial& partial);
  void sweep(ParticleStore& store, const api::ParticleView& view, double step, bool firstStep);
  HeatBody heatBody(const ParticleStore& store, size_t i) const;
  void relaxPair(size_t i, uint32_t k, bool sameMaterial, double time);
  void relaxBodies(size_t i, size_t j, double conductance, double time);
  double relaxToward(size_t i, double conductance, double target, double inverseCapacity, double time);
  void relaxSurroundings(const ParticleStore& store, size_t i, double time);
  void relaxSights(size_t i, double time);
  void closeBooks();

  ThermalSettings m_settings;
  SolverSettings m_solver;
  HeatSurroundings m_surroundings;
  std::span<const BakedMaterial> m_materials;
  std::vector<const api::MaterialView*> m_materialViews;
  const api::ThermalPlugin* m_model = nullptr;
  bool m_modelChanged = false;
  std::string m_modelName;
  mutable bool m_putAside = false;  ///< the model threw
  mutable std::optional<std::string> m_fault;
  std::vector<double> m_parameters;
  std::vector<EnthalpyCurves> m_curves;  ///< by material, what the state of its particles was written with
  HeatLedger m_ledger;
  int m_substeps = 0;  ///< explicit steps and sweeps of this frame
  double m_delivered = 1, m_limit = 0;
  double m_time = 0, m_thermalTime = 0;
  bool m_swept = false, m_pairLaw = false, m_boiling = false;

  HeatPairs m_pairs;
  BodyHeating m_bodyHeating;
  BodyFlux m_bodyFlux;
  PluginHeating m_sources;
  HeatInstant m_now, m_next;
  std::vector<Partial> m_partials;
  std::vector<double> m_joules;       ///< of the present substep
  std::vector<double> m_frameJoules;  ///< film and nucleation, once a frame
  std::vector<double> m_watts;        ///< sources, bodies' power and flux, W of thermal time
  RoomVector<double> m_pairWatts;     ///< the model's own pair law, per list entry
  std::vector<double> m_lawRates;     ///< 1/s, the fastest of that law, by chunk
  double m_pairRate = 0;              ///< and of all
  std::vector<uint8_t> m_insulated;   ///< by particle; none where no body is
  std::vector<float> m_convection;    ///< W/(m2 K), likewise: see HeatPairs::Options
  std::vector<double> m_newTemperature;
  std::vector<api::Phase> m_newPhase;
  std::vector<double> m_fixedConductance;  ///< W/K: other materials, air and radiation
  std::vector<uint32_t> m_boilingPartners;
  mutable std::vector<double> m_energies;  ///< J, scratch of energy()
  mutable double m_lastEnergy = 0;         ///< J, of m_lastCount particles
  mutable size_t m_lastCount = 0;
  std::vector<HeatBody> m_bodies;  ///< of a sweep
};

}  // namespace ps
