// SPDX-License-Identifier: Apache-2.0
// Particles are 16-byte float4: blocks of four are loaded and interleaved into x, y, z, w, and go back the same way.
#include "pairprojection.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pairprojection.cpp"
#include "hwy/foreach_target.h"  // before highway.h
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ps::constraint {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using DBlock = hn::Full128<float>;
constexpr size_t kLanes = HWY_MIN(HWY_LANES(float), 16);

struct Vectors4 {
  V x, y, z, w;
};

/// Block b from particle id[8 b].
HWY_INLINE V loadBlocks(const float* base, const uint32_t* id) {
  const DBlock d1;
#if HWY_MAX_BYTES >= 64
  const hn::Half<D> d2;
  return hn::Combine(D(),
                     hn::Combine(d2, hn::Load(d1, base + 4 * size_t{id[24]}), hn::Load(d1, base + 4 * size_t{id[16]})),
                     hn::Combine(d2, hn::Load(d1, base + 4 * size_t{id[8]}), hn::Load(d1, base + 4 * size_t{id[0]})));
#elif HWY_MAX_BYTES == 32
  return hn::Combine(D(), hn::Load(d1, base + 4 * size_t{id[8]}), hn::Load(d1, base + 4 * size_t{id[0]}));
#else
  return hn::Load(d1, base + 4 * size_t{id[0]});
#endif
}

HWY_INLINE void storeBlocks(V v, float* base, const uint32_t* id) {
  const DBlock d1;
#if HWY_MAX_BYTES >= 64
  const hn::Half<D> d2;
  const auto low = hn::LowerHalf(d2, v), high = hn::UpperHalf(d2, v);
  hn::Store(hn::LowerHalf(d1, low), d1, base + 4 * size_t{id[0]});
  hn::Store(hn::UpperHalf(d1, low), d1, base + 4 * size_t{id[8]});
  hn::Store(hn::LowerHalf(d1, high), d1, base + 4 * size_t{id[16]});
  hn::Store(hn::UpperHalf(d1, high), d1, base + 4 * size_t{id[24]});
#elif HWY_MAX_BYTES == 32
  hn::Store(hn::LowerHalf(d1, v), d1, base + 4 * size_t{id[0]});
  hn::Store(hn::UpperHalf(d1, v), d1, base + 4 * size_t{id[8]});
#else
  hn::Store(v, d1, base + 4 * size_t{id[0]});
#endif
}

/// Of every second particle from `id` on.
HWY_INLINE Vectors4 load(const api::Float4* particles, const uint32_t* id) {
  const D d;
  const hn::Repartition<double, D> dd;
  const float* base = &particles->x;
  const V a0 = loadBlocks(base, id), a1 = loadBlocks(base, id + 2);
  const V a2 = loadBlocks(base, id + 4), a3 = loadBlocks(base, id + 6);
  const auto xy01 = hn::BitCast(dd, hn::InterleaveLower(d, a0, a1));  // x0 x1 y0 y1 in each block
  const auto zw01 = hn::BitCast(dd, hn::InterleaveUpper(d, a0, a1));
  const auto xy23 = hn::BitCast(dd, hn::InterleaveLower(d, a2, a3));
  const auto zw23 = hn::BitCast(dd, hn::InterleaveUpper(d, a2, a3));
  return {hn::BitCast(d, hn::InterleaveLower(dd, xy01, xy23)), hn::BitCast(d, hn::InterleaveUpper(dd, xy01, xy23)),
          hn::BitCast(d, hn::InterleaveLower(dd, zw01, zw23)), hn::BitCast(d, hn::InterleaveUpper(dd, zw01, zw23))};
}

HWY_INLINE void store(const Vectors4& v, api::Float4* particles, const uint32_t* id) {
  const D d;
  const hn::Repartition<double, D> dd;
  float* base = &particles->x;
  const auto xy01 = hn::BitCast(dd, hn::InterleaveLower(d, v.x, v.y));  // x0 y0 x1 y1 in each block
  const auto xy23 = hn::BitCast(dd, hn::InterleaveUpper(d, v.x, v.y));
  const auto zw01 = hn::BitCast(dd, hn::InterleaveLower(d, v.z, v.w));
  const auto zw23 = hn::BitCast(dd, hn::InterleaveUpper(d, v.z, v.w));
  storeBlocks(hn::BitCast(d, hn::InterleaveLower(dd, xy01, zw01)), base, id);
  storeBlocks(hn::BitCast(d, hn::InterleaveUpper(dd, xy01, zw01)), base, id + 2);
  storeBlocks(hn::BitCast(d, hn::InterleaveLower(dd, xy23, zw23)), base, id + 4);
  storeBlocks(hn::BitCast(d, hn::InterleaveUpper(dd, xy23, zw23)), base, id + 6);
}

/// To the nearest image.
HWY_INLINE V shortened(V c, float period) {
  const D d;
  const V images = hn::Div(c, hn::Set(d, period));
  const V half = hn::IfThenElse(hn::Lt(images, hn::Zero(d)), hn::Set(d, -0.5f), hn::Set(d, 0.5f));
  const V whole = hn::Add(hn::Trunc(hn::Add(images, half)), hn::Zero(d));
  return hn::Sub(c, hn::Mul(hn::Set(d, period), whole));
}

HWY_INLINE V softnessOf(const BondSoftness& softness, size_t k, V /*inverseMasses*/, M& /*acts*/) {
  const D d;
  return hn::Mul(hn::LoadU(d, softness.compliance + k), hn::Set(d, softness.perDt2));
}

HWY_INLINE V softnessOf(const SpringSoftness& softness, size_t k, V inverseMasses, M& acts) {
  const D d;
  const V kind = hn::LoadU(d, softness.kind + k);
  const V later =
      hn::IfThenElse(hn::Lt(kind, hn::Set(d, 1.5f)), hn::Set(d, softness.ofKind[1]), hn::Set(d, softness.ofKind[2]));
  const V own = hn::IfThenElse(hn::Lt(kind, hn::Set(d, 0.5f)), hn::Set(d, softness.ofKind[0]), later);
  acts = hn::And(acts, hn::Ge(own, hn::Zero(d)));
  return hn::Max(own, hn::Mul(hn::Set(d, softness.perInverseMass), inverseMasses));
}

template <bool kPeriodic, class Softness>
size_t projectLanes(const api::MovableParticles& particles, const Pairs& pairs, const Softness& softness) {
  const D d;
  const api::ParticleView& p = particles;
  const float period[3] = {static_cast<float>(p.period.x), static_cast<float>(p.period.y),
                           static_cast<float>(p.period.z)};
  const V zero = hn::Zero(d), damping = hn::Set(d, pairs.damping), damped = hn::Set(d, 1 + pairs.damping);
  const bool rubs = pairs.damping > 0;
  size_t k = 0;
  for (; k + kLanes <= pairs.count; k += kLanes) {
    const uint32_t *i = pairs.particles + 2 * k, *j = i + 1;
    Vectors4 a = load(particles.position, i), b = load(particles.position, j);
    const V wa = load(p.velocity, i).w, wb = load(p.velocity, j).w;
    V x = hn::Sub(a.x, b.x), y = hn::Sub(a.y, b.y), z = hn::Sub(a.z, b.z);
    if constexpr (kPeriodic) {
      if (period[0] > 0) x = shortened(x, period[0]);
      if (period[1] > 0) y = shortened(y, period[1]);
      if (period[2] > 0) z = shortened(z, period[2]);
    }
    const V distance = hn::Sqrt(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)));
    const V inverseMasses = hn::Add(wa, wb), multiplier = hn::LoadU(d, pairs.multiplier + k);
    M acts = hn::And(hn::Gt(distance, zero), hn::Gt(inverseMasses, zero));
    const V soft = softnessOf(softness, k, inverseMasses, acts);
    V error = hn::Add(hn::Sub(distance, hn::LoadU(d, pairs.length + k)), hn::Mul(soft, multiplier));
    if (rubs) {
      const Vectors4 from = load(p.previous, i), fromB = load(p.previous, j);
      const V wx = hn::Sub(hn::Sub(a.x, from.x), hn::Sub(b.x, fromB.x));
      const V wy = hn::Sub(hn::Sub(a.y, from.y), hn::Sub(b.y, fromB.y));
      const V wz = hn::Sub(hn::Sub(a.z, from.z), hn::Sub(b.z, fromB.z));
      const V along = hn::Add(hn::Add(hn::Mul(x, wx), hn::Mul(y, wy)), hn::Mul(z, wz));
      error = hn::Add(error, hn::Mul(hn::Div(damping, distance), along));
    }
    const V change = hn::Div(hn::Neg(error), hn::Add(hn::Mul(damped, inverseMasses), soft));
    hn::StoreU(hn::IfThenElse(acts, hn::Add(multiplier, change), multiplier), d, pairs.multiplier + k);
    const V s = hn::Div(change, distance), sa = hn::Mul(s, wa), sb = hn::Mul(s, wb);
    a.x = hn::IfThenElse(acts, hn::Add(a.x, hn::Mul(sa, x)), a.x);
    a.y = hn::IfThenElse(acts, hn::Add(a.y, hn::Mul(sa, y)), a.y);
    a.z = hn::IfThenElse(acts, hn::Add(a.z, hn::Mul(sa, z)), a.z);
    b.x = hn::IfThenElse(acts, hn::Sub(b.x, hn::Mul(sb, x)), b.x);
    b.y = hn::IfThenElse(acts, hn::Sub(b.y, hn::Mul(sb, y)), b.y);
    b.z = hn::IfThenElse(acts, hn::Sub(b.z, hn::Mul(sb, z)), b.z);
    store(a, particles.position, i);
    store(b, particles.position, j);
  }
  return k;
}

template <class Softness>
size_t projectAny(const api::MovableParticles& particles, const Pairs& pairs, const Softness& softness) {
  const api::ParticleView& p = particles;
  return p.period.x > 0 || p.period.y > 0 || p.period.z > 0 ? projectLanes<true>(particles, pairs, softness)
                                                            : projectLanes<false>(particles, pairs, softness);
}
size_t ProjectBonds(const api::MovableParticles& particles, const Pairs& pairs, const BondSoftness& softness) {
  return projectAny(particles, pairs, softness);
}
size_t ProjectSprings(const api::MovableParticles& particles, const Pairs& pairs, const SpringSoftness& softness) {
  return projectAny(particles, pairs, softness);
}

}  // namespace HWY_NAMESPACE
}  // namespace ps::constraint
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ps::constraint {
namespace {

HWY_EXPORT(ProjectBonds);
HWY_EXPORT(ProjectSprings);

void shorten(float& c, double period) {
  if (!(period > 0)) return;
  const auto length = static_cast<float>(period);
  const float images = c / length;
  c -= length * (std::trunc(images + (images < 0 ? -0.5f : 0.5f)) + 0.0f);
}

float softnessOf(const BondSoftness& softness, size_t k, float /*inverseMasses*/) {
  return softness.compliance[k] * softness.perDt2;
}
float softnessOf(const SpringSoftness& softness, size_t k, float inverseMasses) {
  const float kind = softness.kind[k], own = softness.ofKind[kind < 0.5f ? 0 : kind < 1.5f ? 1 : 2];
  return own < 0 ? own : std::max(own, softness.perInverseMass * inverseMasses);
}

template <class Softness>
void projectOne(const api::MovableParticles& particles, const Pairs& pairs, const Softness& softness, size_t k) {
  const api::ParticleView& p = particles;
  const uint32_t i = pairs.particles[2 * k], j = pairs.particles[2 * k + 1];
  api::Float4 &a = particles.position[i], &b = particles.position[j];
  const float wa = p.velocity[i].w, wb = p.velocity[j].w, damping = pairs.damping;
  float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
  shorten(x, p.period.x), shorten(y, p.period.y), shorten(z, p.period.z);
  const float distance = std::sqrt(x * x + y * y + z * z), soft = softnessOf(softness, k, wa + wb);
  if (!(distance > 0) || !(wa + wb > 0) || soft < 0) return;
  float error = distance - pairs.length[k] + soft * pairs.multiplier[k];
  if (damping > 0) {
    const api::Float4 &from = p.previous[i], &fromB = p.previous[j];
    const float wx = (a.x - from.x) - (b.x - fromB.x), wy = (a.y - from.y) - (b.y - fromB.y),
                wz = (a.z - from.z) - (b.z - fromB.z);
    error += damping / distance * (x * wx + y * wy + z * wz);
  }
  const float change = -error / ((1 + damping) * (wa + wb) + soft);
  pairs.multiplier[k] += change;
  const float s = change / distance, sa = s * wa, sb = s * wb;
  a.x += sa * x, a.y += sa * y, a.z += sa * z;
  b.x -= sb * x, b.y -= sb * y, b.z -= sb * z;
}

}  // namespace

void projectPairsPlainly(const api::MovableParticles& particles, const Pairs& pairs, const BondSoftness& softness,
                         size_t first) {
  for (size_t k = first; k < pairs.count; ++k) projectOne(particles, pairs, softness, k);
}
void projectPairsPlainly(const api::MovableParticles& particles, const Pairs& pairs, const SpringSoftness& softness,
                         size_t first) {
  for (size_t k = first; k < pairs.count; ++k) projectOne(particles, pairs, softness, k);
}

void projectPairs(const api::MovableParticles& particles, const Pairs& pairs, const BondSoftness& softness) {
  projectPairsPlainly(particles, pairs, softness, HWY_DYNAMIC_DISPATCH(ProjectBonds)(particles, pairs, softness));
}
void projectPairs(const api::MovableParticles& particles, const Pairs& pairs, const SpringSoftness& softness) {
  projectPairsPlainly(particles, pairs, softness, HWY_DYNAMIC_DISPATCH(ProjectSprings)(particles, pairs, softness));
}

}  // namespace ps::constraint
#endif
