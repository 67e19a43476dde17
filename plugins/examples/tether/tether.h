// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/qtentry.h>

/// A structural constraint: ties of two particles. The host owns them; this says how they are made and how they pull.
class Tether final : public QObject, public ps::api::Described<ps::api::StructuralPlugin> {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_STRUCTURAL_IID FILE "tether.json")
  Q_INTERFACES(ps::api::StructuralPlugin)

 public:
  Tether();

  bool traits(ps::api::StructuralTraits* out) const noexcept override;
  void build(const ps::api::ConstraintContext& context, const ps::api::ParticleView& particles,
             const ps::api::NeighbourView& neighbours, ps::api::Span<const uint32_t> members,
             ps::api::ConstraintSink& sink) const override;
  void project(const ps::api::ConstraintContext& context, const ps::api::MovableParticles& particles,
               const ps::api::ConstraintBatch& batch) const override;
};
