// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/qtentry.h>

/// The smallest thermal model: temperature is the state, and there is no latent heat.
class Sensible final : public QObject, public ps::api::Described<ps::api::ThermalPlugin> {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_THERMAL_IID FILE "sensible.json")
  Q_INTERFACES(ps::api::ThermalPlugin)

 public:
  Sensible();

  ps::api::List<ps::api::FieldDeclaration> fields() const noexcept override;
  void initialise(const ps::api::ThermalContext& context, const ps::api::ParticleView& particles, size_t first,
                  size_t last, const double* temperature, const ps::api::Phase* phase) const override;
  void addHeat(const ps::api::ThermalContext& context, const ps::api::ParticleView& particles, size_t first,
               size_t last, const double* joules, double dt) const override;
  void derive(const ps::api::ThermalContext& context, const ps::api::ParticleView& particles, size_t first, size_t last,
              const ps::api::ThermalOutput& output) const override;
  void energy(const ps::api::ThermalContext& context, const ps::api::ParticleView& particles, size_t first, size_t last,
              double* joules) const override;
};
