// SPDX-License-Identifier: MIT
#include "tether.h"

#include <cmath>
#include <vector>

namespace {

using namespace ps::api;

constexpr double kSlack = 0.05;

constexpr ParameterDeclaration kParameters[] = {atReset(
    {"slack", "Slack", "", "", ParameterKind::Number, Scale::Linear, kSlack, 0, 0.5, 0, 10, "%", 100, 0, "", "Tether",
     "How much longer than at the start a tie may become before it pulls.", "chain 0 %, loose net 20 %", ""})};
constexpr FieldDeclaration kValues[] = {{"longest", "m", "Length from which on it pulls", FieldType::Float32}};

float distance(const ParticleView& particles, uint32_t i, uint32_t j) {
  const Float4 d = separation(particles, i, j);
  return std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
}

}  // namespace

Tether::Tether()
    : Described(
          {"Tether",
           "Ties each particle to its nearest neighbours by threads that cannot be stretched but hang loose when they "
           "are shorter: a net, chain mail. It never breaks, and gives in only as far as the iterations do not reach.",
           listOf(kParameters)}) {}

bool Tether::traits(StructuralTraits* out) const noexcept { return fill(out, {.arity = 2, .values = listOf(kValues)}); }

void Tether::build(const ConstraintContext& context, const ParticleView& particles, const NeighbourView& neighbours,
                   Span<const uint32_t> members, ConstraintSink& sink) const {
  const double slack = context.parameters.size > 0 ? context.parameters[0] : kSlack;
  const auto reach = static_cast<float>(1.2 * context.spacing);  // along the lattice's axes
  std::vector<uint8_t> isNew(particles.count, 0);
  for (const uint32_t i : members) isNew[i] = 1;
  for (const uint32_t i : members) {
    for (uint32_t q = neighbours.begin[i]; q < neighbours.last[i]; ++q) {
      const uint32_t j = neighbours.index[q], pair[] = {i, j};
      const float length = distance(particles, i, j);
      const auto longest = static_cast<float>((1 + slack) * double{length});
      if (isNew[j] != 0 && i < j && length < reach) sink.add(pair, &longest);  // each pair once
    }
  }
}

void Tether::project(const ConstraintContext&, const MovableParticles& particles, const ConstraintBatch& batch) const {
  const ParticleView& p = particles;
  for (size_t k = 0; k < batch.count; ++k) {
    const uint32_t i = batch.particles[2 * k], j = batch.particles[2 * k + 1];
    const Float4 d = separation(p, i, j);
    const float length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), longest = batch.values[0][k];
    const float wi = p.velocity[i].w, wj = p.velocity[j].w;  // inverse masses
    if (length <= longest || !(wi + wj > 0)) continue;
    const float s = (length - longest) / (length * (wi + wj));
    Float4 &a = particles.position[i], &b = particles.position[j];
    a.x -= s * wi * d.x, a.y -= s * wi * d.y, a.z -= s * wi * d.z;
    b.x += s * wj * d.x, b.y += s * wj * d.y, b.z += s * wj * d.z;
  }
}
