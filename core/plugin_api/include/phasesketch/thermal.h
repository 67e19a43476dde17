// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/plugin.h>

#define PHASESKETCH_THERMAL_IID "org.phasesketch.Thermal/0.9"
#define PHASESKETCH_HEAT_SOURCE_IID "org.phasesketch.HeatSource/0.9"

namespace ps::api {

/// Capability of a model that drops or invents heat by design: extension(kOpensEnergy) is not nullptr. The
/// host then lists the open balance among the limits of the model, where it would otherwise flag a fault.
inline constexpr const char* kOpensEnergy = "opens_energy";

/// Capability of a model with a pair law of its own: extension(kPairRates) is its PairRates. The host then takes heat
/// steps that are stable for that law as well; without it, as for its own conduction alone.
inline constexpr const char* kPairRates = "pair_rates";

struct ThermalContext {
  double pressure;                ///< Pa
  double ambientTemperature;      ///< K
  Span<const double> parameters;  ///< in the order of parameters()
  Span<const MaterialView* const> materials;
  double supportRadius = 0;  ///< m, from which on kernels are zero
  double time = 0;           ///< s of the scene, at the start of the frame
  double thermalTime = 0;    ///< s of its thermal clock, likewise
};

/// How fast a model's own pair law acts.
class PairRates {
 public:
  /// The largest, among particles [first, last), of the sum of conductances to all neighbours over the particle's
  /// smallest heat capacity, in 1/s (Gershgorin's bound). May throw.
  virtual double fastestPairRate(const ThermalContext&, const ParticleView&, const NeighbourView&, size_t first,
                                 size_t last) const = 0;

 protected:
  ~PairRates() = default;
};

/// What a thermal model writes for the host, per particle.
struct ThermalOutput {
  double* temperature;  ///< K
  float* solidFraction;
  float* liquidFraction;
  float* gasFraction;
};

/// Keeps the caloric state of particles. The host computes the heat that flows (conduction, walls, air, sources) and
/// hands it over in joules; equal and opposite for every pair, so a model that adds it up conserves energy.
class ThermalPlugin : public Plugin {
 public:
  /// State fields, e.g. specific_enthalpy (J/kg, Float64).
  virtual List<FieldDeclaration> fields() const = 0;
  /// Sets the state of particles [first, last) from temperature in K and the shares of solid, liquid and vapour that
  /// the view shows: of newborn matter, whose shares are those of `phase`, and of matter that is here when this model
  /// takes over, or when its material's caloric data have changed. Shares decide on a plateau, and where they are not
  /// in balance the state should hold their heat (undercooled, superheated). May throw.
  virtual void initialise(const ThermalContext&, const ParticleView&, size_t first, size_t last,
                          const double* temperature, const Phase* phase) const = 0;
  /// Adds joules[i] to particles [first, last); `dt` in s of thermal time: a step that is stable for what flows, the
  /// whole frame's where nothing does, or 0 for what a hand gives between two frames. May throw.
  virtual void addHeat(const ThermalContext&, const ParticleView&, size_t first, size_t last, const double* joules,
                       double dt) const = 0;
  /// Temperature and fractions from the state. May throw.
  virtual void derive(const ThermalContext&, const ParticleView&, size_t first, size_t last,
                      const ThermalOutput&) const = 0;
  /// Thermal energy of each particle in J, for the ledger. May throw.
  virtual void energy(const ThermalContext&, const ParticleView&, size_t first, size_t last, double* joules) const = 0;
  /// Optional own pair law: writes, for every list entry q of particles [first, last), the watts that flow from the
  /// neighbour into the particle; must be antisymmetric. False: the host conducts (Cleary & Monaghan 1999). May throw.
  virtual bool pairFlux(const ThermalContext&, const ParticleView&, const NeighbourView&, size_t /*first*/,
                        size_t /*last*/, double* /*watts*/) const {
    return false;
  }
};

/// Heat that comes up in matter, or is taken from it, whatever the thermal model: an induction coil, light, a reaction.
/// A scene may use any number of them; what they add up to is booked as heaters.
class HeatSourcePlugin : public Plugin {
 public:
  /// Fields of its own, made by the host, zero at birth.
  virtual List<FieldDeclaration> fields() const { return {}; }
  /// Adds W of thermal time to watts[i] of particles [first, last), once a frame; negative ones cool. Reads any
  /// particle. May throw.
  virtual void addWatts(const ThermalContext&, const ParticleView&, size_t first, size_t last, double* watts) const = 0;
};

}  // namespace ps::api
