// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/qtentry.h>

/// A constraint over groups of any number of particles: each body is drawn together towards its centre of mass.
class Clump final : public QObject, public ps::api::Described<ps::api::GroupPlugin> {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_GROUP_IID FILE "clump.json")
  Q_INTERFACES(ps::api::GroupPlugin)

 public:
  Clump();

  bool traits(ps::api::GroupTraits* out) const noexcept override;
  void build(const ps::api::ConstraintContext& context, const ps::api::ParticleView& particles,
             const ps::api::NeighbourView& neighbours, ps::api::Span<const uint32_t> members,
             const ps::api::GroupBatch& all, ps::api::GroupSink& sink) const override;
  void project(const ps::api::ConstraintContext& context, const ps::api::MovableParticles& particles,
               const ps::api::GroupBatch& batch) const override;
};
