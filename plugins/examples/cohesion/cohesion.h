// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/qtentry.h>

/// Cohesion: a constraint over neighbours. It keeps no lists; gather() reads neighbours and writes its own particle.
class Cohesion final : public QObject, public ps::api::ConstraintPlugin {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_CONSTRAINT_IID FILE "cohesion.json")
  Q_INTERFACES(ps::api::ConstraintPlugin)

 public:
  const char* label() const noexcept override;
  const char* help() const noexcept override;
  ps::api::ParameterList parameters() const noexcept override;
  ps::api::ConstraintTraits traits() const noexcept override;
  void gather(const ps::api::ConstraintContext& context, const ps::api::ParticleView& particles,
              const ps::api::NeighbourView& neighbours, size_t first, size_t last,
              ps::api::Float4* correction) const override;
};
