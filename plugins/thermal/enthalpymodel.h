// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <phasesketch/thermal.h>

namespace ps::thermal {

/// Temperature in K and mass fractions of one material.
struct ThermalState {
  double temperature = 0, solid = 0, liquid = 0, gas = 0;
};

// Enthalpy curves of the three phases in J/kg over temperature in K, 0 for the solid at the melting point of 1 atm.
// They do not depend on pressure, which only chooses the temperatures of balance: so a change of pressure keeps the
// energy, and the latent heats at another pressure follow (Kirchhoff).
double solidEnthalpy(const api::Caloric& caloric, double temperature);
double liquidEnthalpy(const api::Caloric& caloric, double temperature);
double gasEnthalpy(const api::Caloric& caloric, double temperature);

/// State of balance at a specific enthalpy in J/kg (Voller & Cross 1981): piecewise linear and monotone.
ThermalState stateAt(const api::Caloric& caloric, double enthalpy);
/// Specific enthalpy in J/kg of matter of these shares at a temperature. Within a melting range the temperature says
/// how much has melted. Elsewhere each share holds the heat of its phase, away from the balance too: liquid water of
/// 263 K holds more than ice, and stateAt() then says how much of it turns to ice at once. What is undercooled holds no
/// less than what is in balance, and what is superheated no more, so that the state lies between this temperature and
/// the plateau, however far the straight lines would have crossed. Shares of phases that the material does not have are
/// in balance.
double enthalpyAt(const api::Caloric& caloric, double temperature, double solid, double liquid, double gas);

/// The enthalpy method: specific enthalpy is the one state variable, everything else follows from it.
class EnthalpyModel : public api::Described<api::ThermalPlugin> {
 public:
  EnthalpyModel();
  using Described::Described;  ///< for models that differ in what they say

  api::List<api::FieldDeclaration> fields() const noexcept override;
  void initialise(const api::ThermalContext& context, const api::ParticleView& particles, size_t first, size_t last,
                  const double* temperature, const api::Phase* phase) const override;
  void addHeat(const api::ThermalContext& context, const api::ParticleView& particles, size_t first, size_t last,
               const double* joules, double dt) const override;
  void derive(const api::ThermalContext& context, const api::ParticleView& particles, size_t first, size_t last,
              const api::ThermalOutput& output) const override;
  void energy(const api::ThermalContext& context, const api::ParticleView& particles, size_t first, size_t last,
              double* joules) const override;
};

}  // namespace ps::thermal
