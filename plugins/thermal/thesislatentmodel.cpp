// SPDX-License-Identifier: Apache-2.0
#include "thesislatentmodel.h"

#include <algorithm>
#include <stdexcept>

namespace ps::thermal {
namespace {

using State = ThesisLatentModel::State;

struct Fields {
  uint8_t* state;
  double *temperature, *melting, *boiling;

  explicit Fields(const api::ParticleView& particles)
      : state(static_cast<uint8_t*>(particles.fields->write("thesis_latent.state", api::FieldType::UInt8))),
        temperature(
            static_cast<double*>(particles.fields->write("thesis_latent.temperature", api::FieldType::Float64))),
        melting(static_cast<double*>(particles.fields->write("thesis_latent.melting", api::FieldType::Float64))),
        boiling(static_cast<double*>(particles.fields->write("thesis_latent.boiling", api::FieldType::Float64))) {
    if (!state || !temperature || !melting || !boiling) {
      throw std::runtime_error("the particles lack a field of 'thesis_latent'");
    }
  }
};

const api::Caloric& caloricOf(const api::ThermalContext& context, const api::ParticleView& particles, size_t i) {
  return context.materials[particles.material[i]]->caloric();
}

/// J/kg between the ends of a plateau at the scene's pressure.
double meltingThreshold(const api::Caloric& c) {
  return c.melts ? std::max(0.0, liquidEnthalpy(c, c.meltingPoint) - solidEnthalpy(c, c.meltingPoint)) : 0;
}
double boilingThreshold(const api::Caloric& c) {
  return std::max(0.0, gasEnthalpy(c, c.boilingPoint) - liquidEnthalpy(c, c.boilingPoint));
}

/// One particle while it is updated.
struct Particle {
  State state;
  double temperature, melting, boiling;

  void enter(State next, double plateau) {
    state = next;
    temperature = plateau;  // Algorithm 4 drops the overshoot
  }

  void heat(const api::Caloric& c, double perMass) {
    switch (state) {
      case State::Solid:
        temperature += perMass / c.heatCapacitySolid;
        if (c.melts && temperature >= c.meltingPoint) {
          enter(State::MeltingFreezing, c.meltingPoint);
          melting = 0;
        }
        break;
      case State::MeltingFreezing:
        melt(c, perMass);
        break;
      case State::Fluid:
        heatFluid(c, perMass);
        break;
      case State::BoilingCondensing:
        boil(c, perMass);
        break;
      case State::Gas:
        temperature += perMass / c.heatCapacityGas;
        if (temperature <= c.boilingPoint) {
          enter(State::BoilingCondensing, c.boilingPoint);
          boiling = boilingThreshold(c);
        }
        break;
    }
  }

 private:
  void heatFluid(const api::Caloric& c, double perMass) {
    temperature += perMass / c.heatCapacityLiquid;
    if (c.melts && temperature <= c.meltingPoint) {
      enter(State::MeltingFreezing, c.meltingPoint);
      melting = meltingThreshold(c);
    } else if (temperature >= c.boilingPoint) {
      enter(State::BoilingCondensing, c.boilingPoint);
      boiling = 0;
    }
  }

  void melt(const api::Caloric& c, double perMass) {
    const double threshold = meltingThreshold(c);
    temperature = c.meltingPoint;
    melting += perMass;
    if (melting < 0) {
      melting = 0;
      state = State::Solid;
    } else if (melting >= threshold) {
      melting = threshold;
      state = State::Fluid;
    }
  }

  void boil(const api::Caloric& c, double perMass) {
    const double threshold = boilingThreshold(c);
    temperature = c.boilingPoint;
    boiling += perMass;
    if (boiling < 0) {
      boiling = 0;
      state = State::Fluid;
    } else if (boiling >= threshold) {
      boiling = threshold;
      state = State::Gas;
    }
  }
};

/// What the shares of particle i amount to at a temperature, with the sharp plateaus that the algorithm knows.
ThermalState startOf(api::Caloric c, double t, const api::ParticleView& particles, size_t i) {
  c.sublimes = 0;
  c.solidus = c.liquidus = c.meltingPoint;
  return ps::thermal::stateAt(c, enthalpyAt(c, t, double{particles.solidFraction[i]},
                                            double{particles.liquidFraction[i]}, double{particles.gasFraction[i]}));
}

State stateOf(const ThermalState& start) {
  if (start.solid >= 1) return State::Solid;
  if (start.gas >= 1) return State::Gas;
  if (start.solid > 0) return State::MeltingFreezing;
  return start.gas > 0 ? State::BoilingCondensing : State::Fluid;
}

}  // namespace

ThesisLatentModel::ThesisLatentModel()
    : Described({"Thesis latent heat",
                 "The latent-heat bookkeeping of the thesis, with the rule added that lets a particle leave a plateau: "
                 "for comparison. Each plateau drops the heat that overshoots it, up to about half a percent of what "
                 "is supplied, so the energy balance stays open and melting and boiling come a few steps late. No "
                 "melting range and no sublimation. Choose Enthalpy for everything else.",
                 {}}) {}

api::List<api::FieldDeclaration> ThesisLatentModel::fields() const noexcept {
  using api::FieldType;
  static const api::FieldDeclaration list[] = {
      {"thesis_latent.state", "", "0 solid, 1 melting or freezing, 2 fluid, 3 boiling or condensing, 4 gas",
       FieldType::UInt8},
      {"thesis_latent.temperature", "K", "Temperature kept by the state machine", FieldType::Float64},
      {"thesis_latent.melting", "J/kg", "Latent heat of melting taken up so far", FieldType::Float64,
       "Heat of melting"},
      {"thesis_latent.boiling", "J/kg", "Latent heat of boiling taken up so far", FieldType::Float64,
       "Heat of boiling"}};
  return api::listOf(list);
}

void ThesisLatentModel::initialise(const api::ThermalContext& context, const api::ParticleView& particles, size_t first,
                                   size_t last, const double* temperature, const api::Phase*) const {
  const Fields f(particles);
  for (size_t i = first; i < last; ++i) {
    const api::Caloric& c = caloricOf(context, particles, i);
    const ThermalState start = startOf(c, temperature[i], particles, i);
    f.state[i] = stateOf(start);
    f.temperature[i] = start.temperature;
    f.melting[i] = (1 - start.solid) * meltingThreshold(c);
    f.boiling[i] = start.gas * boilingThreshold(c);
  }
}

void ThesisLatentModel::addHeat(const api::ThermalContext& context, const api::ParticleView& particles, size_t first,
                                size_t last, const double* joules, double) const {
  const Fields f(particles);
  for (size_t i = first; i < last; ++i) {
    if (!(particles.mass[i] > 0)) continue;
    Particle p{static_cast<State>(f.state[i]), f.temperature[i], f.melting[i], f.boiling[i]};
    p.heat(caloricOf(context, particles, i), joules[i] / static_cast<double>(particles.mass[i]));
    f.state[i] = p.state;
    f.temperature[i] = p.temperature;
    f.melting[i] = p.melting;
    f.boiling[i] = p.boiling;
  }
}

void ThesisLatentModel::derive(const api::ThermalContext& context, const api::ParticleView& particles, size_t first,
                               size_t last, const api::ThermalOutput& output) const {
  const Fields f(particles);
  for (size_t i = first; i < last; ++i) {
    const api::Caloric& c = caloricOf(context, particles, i);
    double solid = 0, gas = 0, t = f.temperature[i];
    switch (f.state[i]) {
      case State::Solid:
        solid = 1;
        break;
      case State::MeltingFreezing: {
        const double threshold = meltingThreshold(c);
        solid = threshold > 0 ? 1 - std::clamp(f.melting[i] / threshold, 0.0, 1.0) : 0;
        t = c.meltingPoint;
        break;
      }
      case State::BoilingCondensing: {
        const double threshold = boilingThreshold(c);
        gas = threshold > 0 ? std::clamp(f.boiling[i] / threshold, 0.0, 1.0) : 1;
        t = c.boilingPoint;
        break;
      }
      case State::Gas:
        gas = 1;
        break;
      default:
        break;
    }
    output.temperature[i] = t;
    output.solidFraction[i] = static_cast<float>(solid);
    output.gasFraction[i] = static_cast<float>(gas);
    output.liquidFraction[i] = static_cast<float>(1 - solid - gas);
  }
}

void ThesisLatentModel::energy(const api::ThermalContext& context, const api::ParticleView& particles, size_t first,
                               size_t last, double* joules) const {
  const Fields f(particles);
  for (size_t i = first; i < last; ++i) {
    const api::Caloric& c = caloricOf(context, particles, i);
    double h = 0;
    switch (f.state[i]) {
      case State::Solid:
        h = solidEnthalpy(c, f.temperature[i]);
        break;
      case State::MeltingFreezing:
        h = solidEnthalpy(c, c.meltingPoint) + f.melting[i];
        break;
      case State::Fluid:
        h = liquidEnthalpy(c, f.temperature[i]);
        break;
      case State::BoilingCondensing:
        h = liquidEnthalpy(c, c.boilingPoint) + f.boiling[i];
        break;
      default:
        h = gasEnthalpy(c, f.temperature[i]);
        break;
    }
    joules[i] = h * static_cast<double>(particles.mass[i]);
  }
}

}  // namespace ps::thermal
