// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/qtentry.h>

/// A heat source: a lamp that shines straight down and warms what its beam meets first.
class Lamp final : public QObject, public ps::api::Described<ps::api::HeatSourcePlugin> {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_HEAT_SOURCE_IID FILE "lamp.json")
  Q_INTERFACES(ps::api::HeatSourcePlugin)

 public:
  Lamp();

  ps::api::List<ps::api::FieldDeclaration> fields() const override;
  void addWatts(const ps::api::ThermalContext& context, const ps::api::ParticleView& particles, size_t first,
                size_t last, double* watts) const override;
};
