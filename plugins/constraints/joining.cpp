// SPDX-License-Identifier: Apache-2.0
#include "joining.h"

#include "sharedloops.h"

namespace ps::constraint {
namespace {

uint8_t* fieldOf(const api::ParticleView& p, const char* name) {
  return static_cast<uint8_t*>(p.fields->write(name, api::FieldType::UInt8));
}

/// What one thread takes for a particle.
constexpr double kMicroseconds = 0.002;

bool isFluid(api::Motion motion) { return motion == api::Motion::Liquid || motion == api::Motion::Gas; }

}  // namespace

Joining::Joining(const api::ConstraintContext& context, const api::ParticleView& particles)
    : m_p(particles),
      m_cuts(context.cuts),
      m_adhesion(context.materials.size * context.materials.size),
      m_fresh(fieldOf(particles, kFreshField)),
      m_keeper(fieldOf(particles, kKeeperField)) {
  for (const api::MaterialView* m : context.materials) {
    const api::Caloric& caloric = m->caloric();
    const double at = caloric.meltingPoint0;
    m_rules.push_back({static_cast<float>(m->property("freeze_bond_fraction", at)),
                       static_cast<float>(m->property("bond_radius", at) * context.spacing), caloric.solidus,
                       caloric.melts != 0 && m->property("sinters", at) > 0.5});
  }
  const size_t n = context.materials.size;
  for (size_t a = 0; a < n; ++a) {
    for (size_t b = 0; b < n; ++b) {
      const api::MaterialView &x = *context.materials[a], &y = *context.materials[b];
      m_adhesion[a * n + b] = x.adheresTo(y) || y.adheresTo(x) ? 1 : 0;
    }
  }
}

void Joining::noteFluid(const api::Threads* threads) const {
  forShared(threads, m_p.count, kMicroseconds, [&](size_t k) {
    const auto i = static_cast<uint32_t>(k);
    if (!isFluid(m_p.motion[i])) return;
    m_fresh[i] = 1;
    if (keeper(i) == Keeper::Guest) setKeeper(i, Keeper::None);
  });
}

bool Joining::anybody(const api::Threads* threads) const {
  return anyShared(threads, m_p.count, kMicroseconds, [&](size_t k) {
    const auto i = static_cast<uint32_t>(k);
    return m_p.motion[i] == api::Motion::Solid && (fresh(i) || dryJoiner(i));
  });
}

}  // namespace ps::constraint
