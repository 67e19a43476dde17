// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "core/matter/material.h"
#include "core/particles/neighbours.h"
#include "core/particles/particlestore.h"
#include "core/solver/heat/heat.h"
#include "core/solver/heat/phasestage.h"
#include "enthalpymodel.h"

#include <cmath>
#include <map>
#include <vector>

/// Particles on a lattice with heat alone: no motion. What the tests of the thermal stages are built from.
namespace heattest {

/// A material of plain constants; conductivities and heat capacities of liquid and gas follow the solid's.
struct Matter {
  double conductivitySolid = 1, conductivityLiquid = 1, conductivityGas = 0.025;
  double capacitySolid = 1000, capacityLiquid = 1000, capacityGas = 2000;
  double density = 1000;
  double melting = 0, latentFusion = 0;  ///< K; 0: never melts
  double boiling = 0, latentVaporization = 2257e3;
};

inline ps::Material materialOf(const Matter& matter) {
  ps::Material m{"matter", "Matter", {}, {}};
  m.properties = {{"conductivity_solid", matter.conductivitySolid},
                  {"conductivity_liquid", matter.conductivityLiquid},
                  {"conductivity_gas", matter.conductivityGas},
                  {"heat_capacity_solid", matter.capacitySolid},
                  {"heat_capacity_liquid", matter.capacityLiquid},
                  {"heat_capacity_gas", matter.capacityGas},
                  {"density_solid", matter.density},
                  {"density_liquid", matter.density},
                  {"melting_temperature", matter.melting},
                  {"latent_heat_fusion", matter.latentFusion},
                  {"boiling_temperature", matter.boiling},
                  {"latent_heat_vaporization", matter.latentVaporization}};
  return m;
}

/// Water of the reference cases.
inline Matter water() { return {2.2, 0.6, 0.025, 2100, 4186, 2010, 1000, 273.15, 334e3, 373.15, 2257e3}; }

/// Random numbers in [-1, 1), the same everywhere.
class Noise {
 public:
  double next() {
    m_state = m_state * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(m_state >> 11) / 4503599627370496.0 - 1;
  }

 private:
  uint64_t m_state = 1234567;
};

/// Water with its phase diagram (IAPWS, CRC Handbook).
inline ps::Material fullWater() {
  Matter matter = water();
  matter.boiling = 373.124;
  ps::Material m = materialOf(matter);
  m.properties["molar_mass"] = 0.01801528;
  m.properties["triple_temperature"] = 273.16;
  m.properties["triple_pressure"] = 611.657;
  m.properties["latent_heat_sublimation"] = 2834e3;
  m.properties["critical_temperature"] = 647.096;
  m.properties["density_solid"] = 917.0;
  m.properties["density_liquid"] = 998.0;
  return m;
}

/// Carbon dioxide, which sublimes at 1 atm.
inline ps::Material dryIce() {
  ps::Material m = fullWater();
  for (const auto& [key, value] : std::map<std::string, double>{{"melting_temperature", 216.592},
                                                                {"boiling_temperature", 194.686},
                                                                {"latent_heat_fusion", 198e3},
                                                                {"latent_heat_vaporization", 348e3},
                                                                {"latent_heat_sublimation", 571e3},
                                                                {"molar_mass", 0.04401},
                                                                {"triple_temperature", 216.592},
                                                                {"triple_pressure", 517950.0},
                                                                {"critical_temperature", 304.13},
                                                                {"heat_capacity_solid", 1300.0},
                                                                {"heat_capacity_liquid", 1950.0},
                                                                {"heat_capacity_gas", 846.0}}) {
    m.properties[key] = value;
  }
  return m;
}

/// What is stable at a temperature; on the melting and the boiling point the liquid.
inline ps::api::Phase balancedPhase(const ps::api::Caloric& c, double kelvin) {
  if ((c.melts || c.sublimes) && kelvin < c.solidus) return ps::api::Phase::Solid;
  return kelvin <= c.boilingPoint ? ps::api::Phase::Liquid : ps::api::Phase::Gas;
}

class Scene {
 public:
  double spacing = 0.005;
  double pressure = 101325;
  ps::ThermalSettings thermal;
  ps::SolverSettings solver;
  std::vector<ps::Wall> walls;
  ps::Bounds bounds;
  ps::ParticleStore store;
  ps::Neighbours neighbours;
  ps::HeatStage heat;
  std::vector<ps::BakedMaterial> materials;
  ps::thermal::EnthalpyModel enthalpy;
  const ps::api::ThermalPlugin* model = &enthalpy;
  std::vector<double> modelParameters;

  Scene() { thermal.airConvection = 0; }

  void addMaterial(const ps::Material& material) { materials.emplace_back(material, pressure); }

  /// Particle centres at (i + 1/2) spacing, so that a box begins at its corner.
  void addBox(std::array<int, 3> first, std::array<int, 3> count, uint32_t material, double jitter = 0) {
    const size_t begin =
        store.add(static_cast<size_t>(count[0]) * static_cast<size_t>(count[1]) * static_cast<size_t>(count[2]));
    size_t i = begin;
    for (int z = 0; z < count[2]; ++z) {
      for (int y = 0; y < count[1]; ++y) {
        for (int x = 0; x < count[0]; ++x, ++i) {
          const auto at = [&](int axis, int cell) {
            return static_cast<float>((first[static_cast<size_t>(axis)] + cell + 0.5 + jitter * m_noise.next()) *
                                      spacing);
          };
          store.position()[i] = {at(0, x), at(1, y), at(2, z), 0};
          store.material()[i] = material;
        }
      }
    }
  }

  /// Settings reach the stage; call after any change.
  void configure() {
    solver.spacing = spacing;
    heat.configure(thermal, solver, walls, bounds, materials, model, modelParameters);
    phase.configure(solver, materials);
    neighbours.configure(solver.supportRatio * spacing, 0.02 * spacing);
  }

  /// Starts heat with temperature(i) in K and phase(i), mass density spacing^3 where none is set.
  template <class Temperature, class PhaseOf>
  void start(const Temperature& temperature, const PhaseOf& phaseAt) {
    configure();
    std::vector<double> t(store.size());
    std::vector<ps::api::Phase> p(store.size());
    for (size_t i = 0; i < store.size(); ++i) {
      t[i] = temperature(i);
      p[i] = phaseAt(i);
      float& mass = store.mass()[i];
      if (mass <= 0) {
        const double density = materials[store.material()[i]].property("density_solid", t[i]);
        mass = static_cast<float>(density * spacing * spacing * spacing);
      }
    }
    heat.initialise(store, 0, store.size(), t, p);
    phase.initialise(store, 0, store.size(), false);
    neighbours.build(store);
  }
  template <class Temperature>
  void start(const Temperature& temperature) {
    start(temperature,
          [&](size_t i) { return balancedPhase(materials[store.material()[i]].caloric(), temperature(i)); });
  }

  /// Advances `seconds` in frames of up to 35 explicit heat steps, as nothing moves.
  void run(double seconds) {
    heat.advance(store, neighbours, 1e-9);  // measures the stable step
    const double limit = heat.gershgorinLimit(), frame = limit > 0 ? 35 * thermal.cfl * limit : seconds;
    const int frames = std::max(1, static_cast<int>(std::ceil(seconds / frame)));
    for (int k = 0; k < frames; ++k) heat.advance(store, neighbours, seconds / frames);
  }

  double mass() const {
    double sum = 0;
    for (size_t i = 0; i < store.size(); ++i) sum += double{store.mass()[i]};
    return sum;
  }
  /// Mass-weighted mean of a field.
  template <class T>
  double mean(const T* values) const {
    double sum = 0;
    for (size_t i = 0; i < store.size(); ++i) sum += double{store.mass()[i]} * static_cast<double>(values[i]);
    return sum / mass();
  }
  double* enthalpyField() { return static_cast<double*>(store.find("specific_enthalpy", ps::api::FieldType::Float64)); }
  const double* enthalpyField() const {
    return static_cast<const double*>(store.read("specific_enthalpy", ps::api::FieldType::Float64));
  }
  /// True for particles within `half` spacings of the axis through (y, z), in spacings.
  bool nearAxis(size_t i, double y, double z, double half) const {
    const auto& p = store.position()[i];
    return std::abs(double{p.y} / spacing - y) < half && std::abs(double{p.z} / spacing - z) < half;
  }

  ps::PhaseStage phase;

 private:
  Noise m_noise;
};

}  // namespace heattest
