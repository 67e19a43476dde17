// SPDX-License-Identifier: MIT
#pragma once
#include <phasesketch/qtentry.h>

/// Cohesion: a constraint over neighbours. It keeps no lists; gather() reads neighbours and writes a correction for
/// each of the particles that it is called for.
class Cohesion final : public QObject, public ps::api::Described<ps::api::NeighbourPlugin> {
  Q_OBJECT
  Q_PLUGIN_METADATA(IID PHASESKETCH_NEIGHBOUR_IID FILE "cohesion.json")
  Q_INTERFACES(ps::api::NeighbourPlugin)

 public:
  Cohesion();

  bool traits(ps::api::NeighbourTraits* out) const noexcept override;
  void gather(const ps::api::ConstraintContext& context, const ps::api::ParticleView& particles,
              const ps::api::NeighbourView& neighbours, ps::api::Span<const uint32_t> members,
              ps::api::Float4* correction) const override;
};
