// SPDX-License-Identifier: MIT
#include "clump.h"

namespace {

using namespace ps::api;

constexpr double kPull = 2;  // m/s2

constexpr ParameterDeclaration kParameters[] = {
    {"pull", "Pull", "a", "m/s²", ParameterKind::Number, Scale::Linear, kPull, 0, 20, 0, 1000, "", 1, 0, "", "Clump",
     "Acceleration of each particle towards the body's centre of mass, a spacing away from it.",
     "0 nothing, 2 a swarm, 20 a ball", ""}};

}  // namespace

Clump::Clump()
    : Described({"Clump",
                 "Draws each body together towards its centre of mass, with a force that grows with the distance: a "
                 "swarm, a planet. The pulls of a body add up to nothing, so its momentum is kept to rounding.",
                 listOf(kParameters)}) {}

bool Clump::traits(GroupTraits* out) const noexcept { return fill(out, {}); }

void Clump::build(const ConstraintContext&, const ParticleView&, const NeighbourView&, Span<const uint32_t> members,
                  const GroupBatch&, GroupSink& sink) const {
  sink.add(members.data, members.size, nullptr, nullptr);  // no values to begin with
}

void Clump::project(const ConstraintContext& context, const MovableParticles& particles,
                    const GroupBatch& batch) const {
  if (context.iteration > 0) return;  // an acceleration, once per substep
  const ParticleView& p = particles;
  const double pull = context.parameters.size > 0 ? context.parameters[0] : kPull;
  const double share = pull / context.spacing * context.dt * context.dt;
  for (size_t g = 0; g < batch.count; ++g) {
    double mass = 0, x = 0, y = 0, z = 0;
    for (size_t k = batch.begin[g]; k < batch.begin[g + 1]; ++k) {
      const uint32_t i = batch.particles[k];
      const double m = p.mass[i];
      mass += m;
      x += m * double{p.position[i].x}, y += m * double{p.position[i].y}, z += m * double{p.position[i].z};
    }
    for (size_t k = batch.begin[g]; k < batch.begin[g + 1]; ++k) {
      Float4& at = particles.position[batch.particles[k]];
      if (!(p.velocity[batch.particles[k]].w > 0)) continue;  // held in place
      at.x += static_cast<float>(share * (x / mass - double{at.x}));
      at.y += static_cast<float>(share * (y / mass - double{at.y}));
      at.z += static_cast<float>(share * (z / mass - double{at.z}));
    }
  }
}
