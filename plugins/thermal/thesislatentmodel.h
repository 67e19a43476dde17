// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "enthalpymodel.h"

#include <string_view>

namespace ps::thermal {

/// The latent-heat bookkeeping of the 2020 thesis (its Algorithm 4 and equation 4.3), kept for comparison.
///
/// A state machine: a particle is solid, melting or freezing, fluid, boiling or condensing, or gas. Outside a plateau
/// heat changes the temperature, dT = Q/(m c); on a plateau it changes the latent heat, dL = Q/m, clamped to [0,
/// threshold]. As printed no particle ever leaves a plateau, accumulators start at zero even for a liquid, and latent
/// heats are in kJ beside J. Mended here: a plateau is left at either end, it is entered with the accumulator at the
/// end it is entered from, thresholds are in J/kg.
///
/// Kept, because it is the algorithm: heat beyond either end of a plateau is dropped in the step that reaches it, and
/// so is the overshoot in temperature in the step that enters it. The loss is of the order of one step's heat per
/// particle and event: 0.2 to 0.5 % of the heat supplied to a melting column at half the stable step, proportional to
/// the step; events on a heating curve come one to three steps late. Energy is therefore not conserved and the balance
/// stays open. No melting range, no sublimation (a solid above its sublimation point becomes fluid, then boils), and a
/// change of pressure on a plateau loses heat as well. Matter that is to begin in a phase away from the balance begins
/// as the enthalpy model has it, in the state that this phase's heat means.
class ThesisLatentModel : public api::Described<api::ThermalPlugin> {
 public:
  enum State : unsigned char { Solid, MeltingFreezing, Fluid, BoilingCondensing, Gas };

  ThesisLatentModel();

  api::List<api::FieldDeclaration> fields() const noexcept override;
  /// Algorithm 4 drops the heat that overshoots a plateau.
  const void* extension(const char* name) const noexcept override {
    return std::string_view(name) == api::kOpensEnergy ? this : nullptr;
  }
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
