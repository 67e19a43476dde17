// SPDX-License-Identifier: Apache-2.0
#include "springmodel.h"

#include "pairprojection.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ps::constraint {
namespace {

using api::ConstraintBatch;
using api::ConstraintContext;
using api::Float4;
using api::Motion;
using api::NeighbourView;
using api::ParticleView;

/// Neighbours of a square lattice are 1 and 1.414 spacings away, those across a cube 1.732.
constexpr float kStretchReach = 1.2f, kShearReach = 1.6f, kCornerReach = 1.8f;
/// Two neighbours lie opposite each other when the angle between them is more than 143 degrees.
constexpr float kOpposite = -0.8f;
/// Largest k dt²/m of a spring: beyond it more stiffness only makes the solver work harder (Macklin et al. 2019).
constexpr double kMostRatio = 100;

constexpr api::FieldDeclaration kValues[] = {
    {"rest_length", "m", "Length at rest", api::FieldType::Float32},
    {"kind", "", "0 stretch, 1 shear, 2 bend", api::FieldType::Float32},
    {"multiplier", "N·s²", "XPBD multiplier of the substep", api::FieldType::Float32},
};

struct Difference {
  float x, y, z;
  float length() const { return std::sqrt(x * x + y * y + z * z); }
};
Difference between(const Float4& a, const Float4& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

float distance(const ParticleView& p, uint32_t i, uint32_t j) { return between(p.position[i], p.position[j]).length(); }

SpringModel::Kind kindOf(const ConstraintBatch& batch, size_t k) {
  return static_cast<SpringModel::Kind>(static_cast<int>(batch.values[SpringModel::kKind][k]));
}

/// k in N/m that the step resolves for a pair of inverse masses.
double stiffnessLimit(double inverseMasses, double dt) { return kMostRatio * 2 / (inverseMasses * dt * dt); }

/// Finds the springs of newly created particles.
class Builder {
 public:
  Builder(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
          api::Span<const uint32_t> members, bool tiesToFixed, api::ConstraintSink& sink)
      : m_p(p),
        m_lists(lists),
        m_spacing(static_cast<float>(context.spacing)),
        m_tiesToFixed(tiesToFixed),
        m_isNew(p.count, 0),
        m_sink(sink) {
    for (const uint32_t i : members) m_isNew[i] = p.motion[i] == Motion::Solid ? 1 : 0;
  }
  void tieNeighbours(uint32_t i, bool diagonals) {
    if (m_isNew[i] == 0) return;
    for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
      const uint32_t j = m_lists.index[q];
      if ((m_isNew[j] != 0 && j < i) || !kin(i, j)) continue;
      const float d = distance(m_p, i, j);
      if (isNext(i, j, d))
        add(i, j, d, SpringModel::kStretch);
      else if (diagonals && d < kShearReach * m_spacing)
        add(i, j, d, SpringModel::kShear);
    }
  }
  /// Over particle `i`, from one of its neighbours to the opposite one, where one of the three is new.
  void tieOver(uint32_t i) {
    m_near.clear();
    bool anyNew = m_isNew[i] != 0;
    for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
      const uint32_t j = m_lists.index[q];
      if (!kin(i, j) || !isNext(i, j, distance(m_p, i, j))) continue;
      m_near.push_back(j);
      anyNew = anyNew || m_isNew[j] != 0;
    }
    if (!anyNew) return;
    for (size_t a = 0; a < m_near.size(); ++a) {
      for (size_t b = a + 1; b < m_near.size(); ++b) {
        const uint32_t j = m_near[a], k = m_near[b];
        if (m_isNew[i] + m_isNew[j] + m_isNew[k] == 0 || (!moves(j) && !moves(k))) continue;
        const Difference u = between(m_p.position[j], m_p.position[i]), v = between(m_p.position[k], m_p.position[i]);
        const float cosine = (u.x * v.x + u.y * v.y + u.z * v.z) / (u.length() * v.length());
        if (cosine < kOpposite) add(j, k, distance(m_p, j, k), SpringModel::kBend);
      }
    }
  }

 private:
  bool moves(uint32_t i) const { return m_p.motion[i] == Motion::Solid; }
  /// Whether i, of the new body, may be tied to j.
  bool kin(uint32_t i, uint32_t j) const {
    if (m_p.body[i] == m_p.body[j]) return holds(m_p.motion[j]);
    return m_tiesToFixed && m_p.motion[j] == Motion::Static;
  }
  /// Whether the thread or sheet goes from one to the other, d apart: they are neighbours on its lattice, or meet
  /// across a corner, as cells do of what was sketched askew, and are neighbours of nobody else through whom they hold.
  bool isNext(uint32_t i, uint32_t j, float d) const {
    if (d < kStretchReach * m_spacing) return true;
    if (d >= kCornerReach * m_spacing || m_p.body[i] != m_p.body[j]) return false;
    const float reach = m_spacing * (d < kShearReach * m_spacing ? kStretchReach : kShearReach);
    for (uint32_t q = m_lists.begin[i]; q < m_lists.last[i]; ++q) {
      const uint32_t k = m_lists.index[q];
      if (k != j && kin(i, k) && distance(m_p, i, k) < reach && distance(m_p, j, k) < reach) return false;
    }
    return true;
  }
  void add(uint32_t i, uint32_t j, float length, SpringModel::Kind kind) {
    const uint32_t pair[2] = {i, j};
    const float values[SpringModel::kValueCount] = {length, static_cast<float>(kind), 0};
    m_sink.add(pair, values);
  }

  const ParticleView& m_p;
  const NeighbourView& m_lists;
  float m_spacing;
  bool m_tiesToFixed;
  std::vector<uint8_t> m_isNew;
  std::vector<uint32_t> m_near;
  api::ConstraintSink& m_sink;
};

/// Who is tied to whom by stretch springs.
class StretchGraph {
 public:
  StretchGraph(size_t particles, const ConstraintBatch& all, const std::vector<uint8_t>& gone)
      : m_begin(particles + 1) {
    const auto eachStretch = [&](auto&& visit) {
      for (size_t k = 0; k < all.count; ++k) {
        if (gone[k] != 0 || kindOf(all, k) != SpringModel::kStretch) continue;
        visit(all.particles[2 * k], all.particles[2 * k + 1]);
        visit(all.particles[2 * k + 1], all.particles[2 * k]);
      }
    };
    eachStretch([&](uint32_t i, uint32_t) { ++m_begin[i + 1]; });
    for (size_t i = 0; i < particles; ++i) m_begin[i + 1] += m_begin[i];
    m_partner.resize(m_begin[particles]);
    std::vector<uint32_t> next(m_begin.begin(), m_begin.end());
    eachStretch([&](uint32_t i, uint32_t j) { m_partner[next[i]++] = j; });
  }
  bool shareAPartner(uint32_t i, uint32_t j) const {
    for (uint32_t a = m_begin[i]; a < m_begin[i + 1]; ++a) {
      for (uint32_t b = m_begin[j]; b < m_begin[j + 1]; ++b) {
        if (m_partner[a] == m_partner[b]) return true;
      }
    }
    return false;
  }

 private:
  std::vector<uint32_t> m_begin, m_partner;
};

}  // namespace

bool SpringModel::traits(api::StructuralTraits* out) const noexcept {
  return api::fill(out, {.arity = 2, .thin = 1, .values = api::listOf(kValues)});
}

void SpringModel::build(const ConstraintContext& context, const ParticleView& p, const NeighbourView& lists,
                        api::Span<const uint32_t> members, api::ConstraintSink& sink) const {
  const Springs springs = springsOf(context.parameters, context.spacing);
  Builder builder(context, p, lists, members, springs.tiesToFixed, sink);
  const bool diagonals = askedOf(kShear, context.spacing).what != nullptr;
  for (const uint32_t i : members) builder.tieNeighbours(i, diagonals);
  for (uint32_t i = 0; i < p.count; ++i) {
    if (p.body[i] == context.body && holds(p.motion[i])) builder.tieOver(i);
  }
}

void SpringModel::predict(const ConstraintContext&, const ParticleView&, const ConstraintBatch& batch) const {
  std::fill(batch.values[kMultiplier], batch.values[kMultiplier] + batch.count, 0.0f);
}

void SpringModel::project(const ConstraintContext& context, const api::MovableParticles& particles,
                          const ConstraintBatch& batch) const {
  const Springs springs = springsOf(context.parameters, context.spacing);
  const double dt2 = context.dt * context.dt;
  SpringSoftness softness{batch.values[kKind], {}, static_cast<float>(1 / (dt2 * stiffnessLimit(1, context.dt)))};
  for (const Kind kind : {kStretch, kShear, kBend}) {
    const double asked = springs.stiffness[kind];
    softness.ofKind[kind] = asked > 0 ? static_cast<float>(1 / (dt2 * asked)) : -1;
  }
  const Pairs pairs{batch.count, batch.particles, batch.values[kRestLength], batch.values[kMultiplier],
                    static_cast<float>(springs.damping / context.dt)};
  projectPairs(particles, pairs, softness);
}

void SpringModel::topology(const ConstraintContext& context, const ParticleView& p, const NeighbourView&,
                           const ConstraintBatch& all, api::ConstraintSink& sink) const {
  std::vector<uint8_t> gone(all.count, 0);
  for (size_t k = 0; k < all.count; ++k) {
    const uint32_t i = all.particles[2 * k], j = all.particles[2 * k + 1];
    const double most = springsOf(context.parametersOf(p.body[i]), context.spacing).tearStrain;
    const double rest = all.values[kRestLength][k];
    const bool torn = most > 0 && kindOf(all, k) == kStretch && double{distance(p, i, j)} > (1 + most) * rest;
    gone[k] = torn || !holds(p.motion[i]) || !holds(p.motion[j]) ? 1 : 0;
  }
  const StretchGraph graph(p.count, all, gone);
  for (size_t k = 0; k < all.count; ++k) {
    const bool held = kindOf(all, k) == kStretch || graph.shareAPartner(all.particles[2 * k], all.particles[2 * k + 1]);
    if (gone[k] != 0 || !held) sink.remove(k);
  }
}

double SpringModel::energy(const ConstraintContext& context, const ParticleView& p,
                           const ConstraintBatch& batch) const {
  const Springs springs = springsOf(context.parameters, context.spacing);
  double sum = 0;
  for (size_t k = 0; k < batch.count; ++k) {
    const uint32_t i = batch.particles[2 * k], j = batch.particles[2 * k + 1];
    const double inverseMasses = double{p.velocity[i].w} + double{p.velocity[j].w};
    const double asked = springs.stiffness[kindOf(batch, k)];
    if (!(inverseMasses > 0) || !(asked > 0)) continue;
    const double stretch = double{distance(p, i, j)} - double{batch.values[kRestLength][k]};
    sum += 0.5 * std::min(asked, stiffnessLimit(inverseMasses, context.dt)) * stretch * stretch;
  }
  return sum;
}

void SpringModel::limits(const ConstraintContext& context, const ParticleView& p, api::LimitSink& sink) const {
  double inverseMass = 0;  // of the lightest particle
  for (size_t i = 0; i < p.count; ++i) {
    if (p.body[i] == context.body && p.motion[i] == Motion::Solid)
      inverseMass = std::max(inverseMass, double{p.velocity[i].w});
  }
  if (!(inverseMass > 0)) return;
  const Springs springs = springsOf(context.parameters, context.spacing);
  const double most = stiffnessLimit(2 * inverseMass, context.dt);
  for (const Kind kind : {kStretch, kShear, kBend}) {
    const Asked asked = askedOf(kind, context.spacing);
    const double stiffness = springs.stiffness[kind];
    if (stiffness > most) sink.limit(asked.what, asked.perSpring * stiffness, asked.perSpring * most, asked.unit);
  }
}

}  // namespace ps::constraint
